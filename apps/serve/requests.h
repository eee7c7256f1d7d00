#pragma once
// What clients send, read and checked.

#include "serve/studio.h"

#include <string>

namespace faceprobe::serve {

// Throw Refusal(kUsage) with what is wrong.
std::string read_sample_request(const std::string& body);
InsertionRequest read_insertion_request(const std::string& body);

// For people: control characters become spaces, long names are cut at a character's edge, nothing becomes "photo".
std::string shown_name(std::string name);

}  // namespace faceprobe::serve
