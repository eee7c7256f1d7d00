#pragma once
// Blender as a program of its own, working on a script of ours.

#include <filesystem>
#include <string>

namespace faceprobe::bench {

// Runs `script` with the job's name as its argument. False when Blender cannot be run or the script fails; `log` has what it said.
bool run_blender(const std::string& blender, const std::filesystem::path& script, const std::filesystem::path& job,
                 const std::filesystem::path& log);

// "3.4.1"; empty when there is no such program.
std::string blender_version(const std::string& blender);
// Throws Error(kModel) with what to install when there is none.
void require_blender(const std::string& blender);

}  // namespace faceprobe::bench
