#pragma once
// What --json prints: one object a line.

#include <nlohmann/json.hpp>

#include <cstdio>

namespace faceprobe::cli {

// To stdout. Texts that are not UTF-8, such as names of files, have what is wrong in them replaced.
inline void print_json_line(const nlohmann::ordered_json& json) {
  std::printf("%s\n", json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

}  // namespace faceprobe::cli
