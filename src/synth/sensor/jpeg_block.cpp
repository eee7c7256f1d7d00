#include "synth/sensor/jpeg_block.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

using Row = Eigen::Array<float, 8, 1>;
using Rows = std::array<Row, 8>;

constexpr std::array<int, 64> kLuminance = {16, 11, 10, 16, 24,  40,  51,  61,   //
                                            12, 12, 14, 19, 26,  58,  60,  55,   //
                                            14, 13, 16, 24, 40,  57,  69,  56,   //
                                            14, 17, 22, 29, 51,  87,  80,  62,   //
                                            18, 22, 37, 56, 68,  109, 103, 77,   //
                                            24, 35, 55, 64, 81,  104, 113, 92,   //
                                            49, 64, 78, 87, 103, 121, 120, 101,  //
                                            72, 92, 95, 98, 112, 100, 103, 99};
constexpr std::array<int, 64> kChrominance = {17, 18, 24, 47, 99, 99, 99, 99,  //
                                              18, 21, 26, 66, 99, 99, 99, 99,  //
                                              24, 26, 56, 99, 99, 99, 99, 99,  //
                                              47, 66, 99, 99, 99, 99, 99, 99,  //
                                              99, 99, 99, 99, 99, 99, 99, 99,  //
                                              99, 99, 99, 99, 99, 99, 99, 99,  //
                                              99, 99, 99, 99, 99, 99, 99, 99,  //
                                              99, 99, 99, 99, 99, 99, 99, 99};

JpegBlock scaled(const std::array<int, 64>& base, int quality) {
  const int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  JpegBlock table;
  for (int i = 0; i < 64; ++i) {
    const int entry = (base[static_cast<std::size_t>(i)] * percent + 50) / 100;
    table.data()[i] = static_cast<float>(std::clamp(entry, 1, 255));
  }
  return table;
}

// Orthonormal: row u is the cosine of frequency u. The factors C(u) C(v) / 4 of A.3.3 are in it.
JpegBlock cosines() {
  JpegBlock c;
  for (int u = 0; u < 8; ++u) {
    for (int x = 0; x < 8; ++x) {
      c(u, x) = static_cast<float>((u == 0 ? std::sqrt(0.125) : 0.5) * std::cos((2 * x + 1) * u * kPi / 16.0));
    }
  }
  return c;
}

// a * b with rows of eight as single values: a's entries are spread, b's rows stay whole.
inline void multiply(const JpegBlock& a, const Rows& b, Rows& out) {
  for (int i = 0; i < 8; ++i) {
    Row sum = a(i, 0) * b[0];
    for (int k = 1; k < 8; ++k) sum += a(i, k) * b[static_cast<std::size_t>(k)];
    out[static_cast<std::size_t>(i)] = sum;
  }
}

inline void multiply(const Rows& a, const JpegBlock& b, Rows& out) {
  for (std::size_t i = 0; i < 8; ++i) {
    Row sum = a[i](0) * b.row(0).transpose();
    for (int k = 1; k < 8; ++k) sum += a[i](k) * b.row(k).transpose();
    out[i] = sum;
  }
}

}  // namespace

JpegBlock luminance_table(int quality) { return scaled(kLuminance, quality); }
JpegBlock chrominance_table(int quality) { return scaled(kChrominance, quality); }

void quantise_component(float* plane, int width, int height, const JpegBlock& table) {
  const JpegBlock c = cosines();
  const JpegBlock c_transposed = c.transpose();
  const JpegBlock inverse_table = table.inverse();
  Rows rows;
  Rows half;
  for (int top = 0; top < height; top += 8) {
    for (int left = 0; left < width; left += 8) {
      const int columns = std::min(8, width - left);
      const auto row_of = [&](int y) {
        return plane + static_cast<std::size_t>(std::min(top + y, height - 1)) * static_cast<std::size_t>(width) + left;
      };
      for (int y = 0; y < 8; ++y) {
        const float* in = row_of(y);
        Row& row = rows[static_cast<std::size_t>(y)];
        if (columns == 8) {
          row = Eigen::Map<const Row>(in) - 128.0F;
        } else {
          for (int x = 0; x < 8; ++x) row(x) = in[std::min(x, columns - 1)] - 128.0F;
        }
      }
      multiply(c, rows, half);
      multiply(half, c_transposed, rows);
      for (int v = 0; v < 8; ++v) {
        Row& row = rows[static_cast<std::size_t>(v)];
        row = (row * inverse_table.row(v).transpose()).rint() * table.row(v).transpose();
      }
      multiply(c_transposed, rows, half);
      multiply(half, c, rows);
      for (int y = 0; y < std::min(8, height - top); ++y) {
        const Row row = (rows[static_cast<std::size_t>(y)] + 128.0F).rint().max(0.0F).min(255.0F);
        float* out = row_of(y);
        std::copy_n(row.data(), columns, out);
      }
    }
  }
}

}  // namespace faceprobe::synth
