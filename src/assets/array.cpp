#include "assets/array.h"

#include <cmath>

namespace faceprobe::assets {

std::string quoted(const std::filesystem::path& path) {
  std::string text(1, '\'');
  text += path.string();
  text += '\'';
  return text;
}

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text;
  for (const std::size_t side : shape) {
    if (!text.empty()) text += " x ";
    text += std::to_string(side);
  }
  return text.empty() ? "a single number" : text;
}

Eigen::MatrixX3f rows_of_3(const Array& array, const std::string& what) {
  if (array.values.empty() || array.values.size() % 3 != 0) {
    refuse_input(what + " is " + shape_text(array.shape) + " numbers, which are not points of three coordinates.");
  }
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(array.values.data(), static_cast<Eigen::Index>(array.values.size() / 3), 3);
}

Eigen::MatrixXi integer_rows(const Array& array, Eigen::Index columns, const std::string& what) {
  const auto count = static_cast<Eigen::Index>(array.values.size());
  if (count == 0 || count % columns != 0) {
    refuse_input(what + " is " + shape_text(array.shape) + " numbers, which are not rows of " +
                 std::to_string(columns) + ".");
  }
  Eigen::MatrixXi rows(count / columns, columns);
  for (Eigen::Index i = 0; i < count; ++i) {
    const float value = array.values[static_cast<std::size_t>(i)];
    if (!(std::abs(value) <= static_cast<float>(kMaxInteger)) || value != std::floor(value)) {
      refuse_input(what + " holds " + std::to_string(value) + " where a whole number is needed.");
    }
    rows(i / columns, i % columns) = static_cast<int>(value);
  }
  return rows;
}

}  // namespace faceprobe::assets
