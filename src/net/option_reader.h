#pragma once
// Reads a network's options from the JSON text that its weights file carries. The text comes from outside: every key must be
// known and of the right kind, and none may be missing, so that a file of a later version is refused rather than misread.
//
//   OptionReader reader(text);
//   options.widths = reader.integers("widths");
//   reader.finish();

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace faceprobe::net {

// All throw Error(kModel).
class OptionReader {
 public:
  explicit OptionReader(const std::string& text);

  int integer(const std::string& key);
  std::vector<int> integers(const std::string& key);
  float number(const std::string& key);
  std::vector<float> numbers(const std::string& key);
  // No key may be left.
  void finish() const;

 private:
  nlohmann::json take(const std::string& key);

  nlohmann::json options_;
};

// Throws Error(kModel) with the sentence of an options' validate(), if there is one.
void require_valid_options(const std::string& problem);

}  // namespace faceprobe::net
