#include "net/option_reader.h"

#include "faceprobe/core/error.h"

#include <limits>

namespace faceprobe::net {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& what) {
  throw Error(ExitCode::kModel, "The network options in the weights file are not usable: " + what +
                                    ". Use weights made for this version.");
}

int integer_of(const json& value, const std::string& key) {
  // 64 bits first: get<int>() would wrap silently.
  if (!value.is_number_integer()) refuse('"' + key + "\" is no whole number");
  const bool too_large = value.is_number_unsigned() && value.get<std::uint64_t>() > std::numeric_limits<int>::max();
  const auto number = too_large ? 0 : value.get<std::int64_t>();
  if (too_large || number < std::numeric_limits<int>::min()) refuse('"' + key + "\" is out of range");
  return static_cast<int>(number);
}

}  // namespace

OptionReader::OptionReader(const std::string& text) : options_(json::parse(text, nullptr, false)) {
  if (!options_.is_object()) refuse("they are no JSON object");
}

json OptionReader::take(const std::string& key) {
  const auto found = options_.find(key);
  if (found == options_.end()) refuse('"' + key + "\" is missing");
  json value = *found;
  options_.erase(found);
  return value;
}

int OptionReader::integer(const std::string& key) { return integer_of(take(key), key); }

std::vector<int> OptionReader::integers(const std::string& key) {
  const json list = take(key);
  if (!list.is_array()) refuse('"' + key + "\" is no list");
  std::vector<int> result;
  for (const json& value : list) result.push_back(integer_of(value, key));
  return result;
}

float OptionReader::number(const std::string& key) {
  const json value = take(key);
  if (!value.is_number()) refuse('"' + key + "\" is no number");
  return value.get<float>();
}

std::vector<float> OptionReader::numbers(const std::string& key) {
  const json list = take(key);
  if (!list.is_array()) refuse('"' + key + "\" is no list");
  std::vector<float> result;
  for (const json& value : list) {
    if (!value.is_number()) refuse('"' + key + "\" holds something that is no number");
    result.push_back(value.get<float>());
  }
  return result;
}

void OptionReader::finish() const {
  if (!options_.empty()) refuse("they name \"" + options_.begin().key().substr(0, 40) + "\", which is not known");
}

void require_valid_options(const std::string& problem) {
  if (!problem.empty())
    throw Error(ExitCode::kModel, "The network options in the weights file are refused: " + problem);
}

}  // namespace faceprobe::net
