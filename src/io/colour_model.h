#pragma once
// How the code values of one file become linear Rec.709: a curve per channel as a table, then a 3 x 3 matrix where the
// primaries differ; or, for profiles that hold a multi-dimensional table, a colour-management transform.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::io {

struct ColourModel {
  std::string name;  // for Photo::colour_space
  int channels = 3;  // 1 (grey) or 3
  // Linear value of each code, 256 or 65536 of them. One table when all channels share it. Empty: codes are linear floats.
  std::array<std::vector<float>, 3> curve;
  std::optional<Eigen::Matrix3f> matrix;
  // n pixels of `channels` code values in [0, 1] to n pixels of linear RGB. Replaces curve and matrix when set.
  std::function<void(const float* codes, float* rgb, std::size_t n)> transform;

  // n pixels of `channels` codes each, `stride` apart, to 3 n linear values. Colours outside Rec.709 have negative
  // components; those become 0, because light that is later divided and raised to powers must not be negative.
  template <class Code>
  void to_linear(const Code* codes, int stride, std::size_t n, float* rgb) const;
};

// Number of different code values: 256, 65536, or 0 for float.
template <class Code>
constexpr std::size_t level_count() {
  return sizeof(Code) == 1 ? 256 : sizeof(Code) == 2 ? 65536 : 0;
}

// Table of `levels` samples of `curve` over [0, 1].
std::vector<float> sample_curve(std::size_t levels, const std::function<double(double)>& curve);

ColourModel srgb_model(int channels, std::size_t levels);
ColourModel gamma_model(int channels, std::size_t levels, double gamma);
ColourModel linear_model(int channels, std::size_t levels);

}  // namespace faceprobe::io
