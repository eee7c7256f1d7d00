#pragma once
// Internal: cells of comma-separated tables, RFC 4180.

#include <string>

namespace faceprobe::eval {

// The shortest digits that read back as the same number; nothing for what is not finite. The same in any locale.
std::string exact(double value);
// Quoted where the text would end the cell.
std::string csv_cell(const std::string& text);

}  // namespace faceprobe::eval
