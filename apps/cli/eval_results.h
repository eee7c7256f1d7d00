#pragma once
// `faceprobe eval results`.

#include "commands.h"
#include "faceprobe/eval/paper_report.h"

#include <filesystem>

namespace faceprobe::cli {

// A report.json. Throws Error(kInput): not there, too large, or something else.
eval::PaperReport read_report(const std::filesystem::path& json);

CLI::App* add_eval_results(CLI::App& eval, Action& action);

}  // namespace faceprobe::cli
