#pragma once
// A matrix as the bytes of its numbers, row by row: what the scripts for Blender read as arrays.

#include <Eigen/Core>
#include <fstream>

namespace faceprobe::bench {

template <class Matrix>
void append(std::ofstream& file, const Matrix& matrix) {
  using Scalar = typename Matrix::Scalar;
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  file.write(reinterpret_cast<const char*>(rows.data()),
             static_cast<std::streamsize>(static_cast<std::size_t>(rows.size()) * sizeof(Scalar)));
}

}  // namespace faceprobe::bench
