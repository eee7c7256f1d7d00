#pragma once
// Small files of other people's formats, written through the formats' own libraries.

#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::assets::testing {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

void write_text(const std::filesystem::path& path, std::string_view text);

// A .npy of the given type ('<f4', ...), from raw values.
std::string npy_text(const std::string& descr, const std::vector<std::size_t>& shape, std::span<const std::byte> values,
                     int version = 1, bool fortran = false);
template <class T>
std::string npy_text(const std::string& descr, const std::vector<std::size_t>& shape, const std::vector<T>& values) {
  return npy_text(descr, shape, std::as_bytes(std::span(values)));
}
void write_npz(const std::filesystem::path& path, const std::map<std::string, std::string>& entries);

enum class MatVersion { k5, k73 };
// Matrices of doubles.
void write_mat(const std::filesystem::path& path, const std::map<std::string, Eigen::MatrixXd>& variables,
               MatVersion version);

struct H5Data {
  std::vector<std::uint64_t> shape;
  std::vector<float> numbers;  // written as such, or, where the name ends in "cells", as 32-bit integers
  std::string text;            // in place of numbers
};
void write_h5(const std::filesystem::path& path, const std::map<std::string, H5Data>& datasets);

}  // namespace faceprobe::assets::testing
