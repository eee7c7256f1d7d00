#pragma once
// Which fields a JSON has, and which a page of docs/ names: headings name the objects, the first column of their tables the fields.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::pipeline::testing {

// An object as the page names it, and one of its fields. Objects go by the last name on the way to them.
using Field = std::pair<std::string, std::string>;

inline void add_fields(const nlohmann::json& value, const std::string& object, std::set<Field>& fields) {
  if (value.is_array()) {
    for (const nlohmann::json& item : value) add_fields(item, object, fields);
  }
  if (!value.is_object()) return;
  for (const auto& [name, item] : value.items()) {
    fields.emplace(object, name);
    add_fields(item, name, fields);
  }
}

inline std::vector<std::string> names_in(const std::string& text) {
  static const std::regex name("`([^`]+)`");
  std::vector<std::string> names;
  for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it) names.push_back((*it)[1].str());
  return names;
}

// `page`: its name in docs/.
inline std::set<Field> documented_fields(const std::string& page) {
  const auto path = std::filesystem::path(__FILE__).parent_path().parent_path().parent_path() / "docs" / page;
  std::ifstream file(path);
  EXPECT_TRUE(file.is_open()) << path;
  std::set<Field> fields;
  std::vector<std::string> objects;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("## ")) objects = names_in(line);
    if (!line.starts_with("| `")) continue;
    for (const std::string& name : names_in(line.substr(0, line.find('|', 1)))) {
      for (const std::string& object : objects) fields.emplace(object, name);
    }
  }
  return fields;
}

}  // namespace faceprobe::pipeline::testing
