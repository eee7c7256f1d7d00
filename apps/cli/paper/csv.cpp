#include "paper/csv.h"

#include "faceprobe/core/error.h"

#include <algorithm>
#include <fstream>

namespace faceprobe::cli {

std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      fields.emplace_back();
    } else if (c != '\r') {
      fields.back() += c;
    }
  }
  return fields;
}

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
  table.header = csv_fields(line);
  while (std::getline(file, line)) {
    if (line.empty()) continue;
    table.rows.push_back(csv_fields(line));
    if (table.rows.back().size() != table.header.size()) {
      throw Error(ExitCode::kInput, path.string() + " has a row of " + std::to_string(table.rows.back().size()) +
                                        " fields under a header of " + std::to_string(table.header.size()) + ".");
    }
  }
  return table;
}

}  // namespace faceprobe::cli
