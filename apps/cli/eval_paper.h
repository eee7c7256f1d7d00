#pragma once
// `faceprobe eval paper`.

#include "commands.h"

namespace faceprobe::cli {

CLI::App* add_eval_paper(CLI::App& eval, Action& action);

}  // namespace faceprobe::cli
