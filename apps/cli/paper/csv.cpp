#include "paper/csv.h"

#include "faceprobe/core/error.h"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace faceprobe::cli {

namespace {

std::vector<std::string> fields_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> fields;
  std::stringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  if (!line.empty() && line.back() == ',') fields.emplace_back();
  return fields;
}

}  // namespace

std::size_t CsvTable::column(const std::string& name) const {
  const auto found = std::find(header.begin(), header.end(), name);
  if (found == header.end()) throw Error(ExitCode::kInput, "The table has no column '" + name + "'.");
  return static_cast<std::size_t>(found - header.begin());
}

CsvTable read_csv(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw Error(ExitCode::kInput, path.string() + " cannot be read or is empty.");
  CsvTable table;
  table.header = fields_of(line);
  while (std::getline(file, line)) {
    if (line.empty()) continue;
    table.rows.push_back(fields_of(line));
    if (table.rows.back().size() != table.header.size()) {
      throw Error(ExitCode::kInput, path.string() + " has a row of " + std::to_string(table.rows.back().size()) +
                                        " fields under a header of " + std::to_string(table.header.size()) + ".");
    }
  }
  return table;
}

}  // namespace faceprobe::cli
