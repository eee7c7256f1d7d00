#pragma once
// Comma-separated tables that come with the data: one header row, one record a line, fields with commas in quotes.

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::cli {

// The fields of one line, at least one.
std::vector<std::string> csv_fields(const std::string& line);

struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  // each as long as the header

  // Index of a column. Throws Error(kInput) when the table has none of that name.
  std::size_t column(const std::string& name) const;
};

// Throws Error(kInput) when the file cannot be read or a row has another length than the header.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace faceprobe::cli
