#pragma once
// Numbers read from a file of arrays, whatever its format.

#include "faceprobe/core/error.h"

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::assets {

// Values in C order: the last index is the fastest. Integers are kept as floats too; readers refuse those that do not fit
// (kMaxInteger), far more than a mesh has vertices.
struct Array {
  std::vector<std::size_t> shape;
  bool is_integer = false;
  std::vector<float> values;
};
inline constexpr double kMaxInteger = 16'777'216;  // 2^24

// The path in quotes, for sentences.
std::string quoted(const std::filesystem::path& path);
// "100 x 11248 x 3"
std::string shape_text(const std::vector<std::size_t>& shape);

[[noreturn]] inline void refuse_input(const std::string& sentence) { throw Error(ExitCode::kInput, sentence); }

// The values as rows of 3, or of other widths; Error(kInput) when their number does not fit. `what` names the array and its file.
Eigen::MatrixX3f rows_of_3(const Array& array, const std::string& what);
Eigen::MatrixXi integer_rows(const Array& array, Eigen::Index columns, const std::string& what);

}  // namespace faceprobe::assets
