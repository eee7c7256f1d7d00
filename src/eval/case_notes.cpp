#include "eval/case_notes.h"

#include "faceprobe/core/error.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace faceprobe::eval {
namespace {

constexpr std::size_t kLongestLabel = 80;

[[noreturn]] void refuse_notes(const std::string& sentence) { throw Error(ExitCode::kInput, sentence); }

bool is_word(const std::string& text) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && text.size() <= kLongestLabel && std::ranges::all_of(text, fits);
}

bool is_label(const std::string& text) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; };
  return !text.empty() && text.size() <= kLongestLabel && std::ranges::none_of(text, control);
}

std::string no_text(const std::string& file, const std::string& name) {
  return file + " has a label of group '" + name + "' that is no text; put it into quotes.";
}
std::string no_name(const std::string& file, const std::string& name) {
  return file + " has a group named '" + name +
         "'; a name is made of a-z, 0-9 and _, at most 80, and is not method or sample.";
}
std::string no_label(const std::string& file, const std::string& name) {
  return file + " has a label of group '" + name +
         "' that is empty, too long or of several lines; allowed are 1 to 80 bytes.";
}

}  // namespace

std::string notes_text(const Case& one) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (!one.groups.empty()) json["groups"] = one.groups;
  if (!one.licence.empty()) json["licence"] = one.licence;
  return json.empty() ? std::string()
                      : json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

void read_notes(const std::string& text, const std::string& file, Case& one) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object())
    refuse_notes(file + " is no JSON object; it looks like {\"groups\": {\"scene\": \"indoor\"}}.");
  if (const auto licence = json.find("licence"); licence != json.end()) {
    if (!licence->is_string()) refuse_notes(file + " has a licence that is no text; put it into quotes.");
    one.licence = licence->get<std::string>();
  }
  const auto groups = json.find("groups");
  if (groups == json.end()) return;
  if (!groups->is_object())
    refuse_notes(file + " has groups that are no object; they look like {\"scene\": \"indoor\"}.");
  for (const auto& [name, label] : groups->items()) {
    if (!label.is_string()) refuse_notes(no_text(file, name));
    one.groups[name] = label.get<std::string>();
  }
}

std::string groups_problem(const std::map<std::string, std::string>& groups, const std::string& file) {
  for (const auto& [name, label] : groups) {
    if (!is_word(name) || name == "method" || name == "sample") return no_name(file, name);
    if (!is_label(label)) return no_label(file, name);
  }
  return {};
}

}  // namespace faceprobe::eval
