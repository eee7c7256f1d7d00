#pragma once
// `faceprobe eval results`.

#include "commands.h"

namespace faceprobe::cli {

CLI::App* add_eval_results(CLI::App& eval, Action& action);

}  // namespace faceprobe::cli
