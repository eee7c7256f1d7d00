#pragma once
// What models/README.md says of the files beside it. A file that was cut short, changed or exchanged has another hash than its card.

#include <filesystem>
#include <string>

namespace faceprobe::pipeline {

// Lower-case hex, of the table row or the section that `card` (Markdown) has for the file of that name; empty where it names none.
std::string hash_on_card(const std::string& card, const std::string& name);

// A sentence when the card beside `model` names another hash than the file has, else empty, as where there is no card. Throws
// Error(kInput) when either cannot be read.
std::string card_mismatch(const std::filesystem::path& model);

}  // namespace faceprobe::pipeline
