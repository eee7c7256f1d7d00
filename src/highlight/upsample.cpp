#include "faceprobe/highlight/upsample.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "highlight/local_models.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace faceprobe::highlight {
namespace {

constexpr int kLargestRadius = 64;

void check_sizes(const Image& small_highlight, const Image& small_picture, const Image& picture, const ByteImage& mask) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(std::string("upsample_highlight: ") + what); };
  if (!small_highlight.same_size(small_picture)) refuse("the small highlight and the small picture differ in size");
  if (picture.empty()) return;
  if (small_picture.empty()) refuse("the small picture is empty");
  if (small_highlight.channels() != 3 || small_picture.channels() != 3 || picture.channels() != 3) {
    refuse("highlight and pictures must have 3 channels");
  }
  if (!mask.empty() && (!mask.same_size(picture) || mask.channels() != 1)) {
    refuse("the mask must have one channel and the size of the full picture");
  }
}

ByteImage usable_pixels(const Image& highlight, const Image& small, const ByteImage& mask) {
  ByteImage usable(small.width(), small.height(), 1);
  // The full pixel under the centre of a small one.
  const auto under = [](int i, int small_size, int size) {
    return static_cast<int>((2LL * i + 1) * size / (2LL * small_size));
  };
  for (int y = 0; y < small.height(); ++y) {
    for (int x = 0; x < small.width(); ++x) {
      float sum = 0;
      for (int c = 0; c < 3; ++c) sum += std::abs(small(x, y, c)) + std::abs(highlight(x, y, c));
      const bool wanted =
          mask.empty() || mask(under(x, small.width(), mask.width()), under(y, small.height(), mask.height()));
      usable(x, y) = wanted && sum <= FLT_MAX;
    }
  }
  return usable;
}

// Where the centre of full pixel i lies between two small ones: the one before, and the share of the next.
struct Between {
  std::size_t cell;
  float next;
};
Between between(int i, int size, int small_size) {
  const float at = (static_cast<float>(i) + 0.5F) * static_cast<float>(small_size) / static_cast<float>(size) - 0.5F;
  const float inside = std::clamp(at, 0.0F, static_cast<float>(small_size - 1));
  const auto cell = static_cast<std::size_t>(inside);
  return {cell, inside - static_cast<float>(cell)};
}

// line: the models of one full row at the small columns, the last one twice.
void apply(const std::vector<Model>& line, const Between& column, const float* picture, float* highlight) {
  // Infinite values, NaN, and what is so bright that it nearly is infinite, hold no light that could be split.
  if (!(std::abs(picture[0]) + std::abs(picture[1]) + std::abs(picture[2]) <= FLT_MAX)) return;
  const Eigen::Vector4f colour(picture[0], picture[1], picture[2], 1);
  const Eigen::Vector4f near = line[column.cell] * colour;
  const Eigen::Vector4f far = line[column.cell + 1] * colour;
  const Eigen::Vector4f mixed = near + column.next * (far - near);
  // In this order std::max turns NaN, from models of absurd values, into no highlight.
  for (int c = 0; c < 3; ++c) highlight[c] = std::min(std::max(0.0F, mixed[c]), std::max(0.0F, picture[c]));
}

}  // namespace

std::string UpsampleOptions::validate() const {
  if (radius_px < 1 || radius_px > kLargestRadius) {
    return "radius_px is " + std::to_string(radius_px) + "; it must be 1 to " + std::to_string(kLargestRadius) + ".";
  }
  if (!(epsilon > 0) || !std::isfinite(epsilon)) {
    return "epsilon is " + std::to_string(epsilon) + "; it must be a finite number above 0.";
  }
  return {};
}

Image upsample_highlight(const Image& small_highlight, const Image& small_picture, const Image& picture,
                         const ByteImage& mask, const UpsampleOptions& options) {
  check_sizes(small_highlight, small_picture, picture, mask);
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  Image highlight(picture.width(), picture.height(), 3);
  if (picture.empty()) return highlight;

  const ByteImage usable = usable_pixels(small_highlight, small_picture, mask);
  const std::vector<Model> models = fit_local_models({small_highlight, small_picture, usable}, options.radius_px,
                                                     static_cast<double>(options.epsilon), options.threads);
  const auto width = static_cast<std::size_t>(small_picture.width());
  std::vector<Between> columns;
  columns.reserve(static_cast<std::size_t>(picture.width()));
  for (int x = 0; x < picture.width(); ++x) columns.push_back(between(x, picture.width(), small_picture.width()));
  parallel_for(picture.height(), options.threads, [&](int first, int last) {
    std::vector<Model> line(width + 1);
    for (int y = first; y < last; ++y) {
      const Between row = between(y, picture.height(), small_picture.height());
      const Model* above = models.data() + row.cell * width;
      const Model* below = row.next > 0 ? above + width : above;
      for (std::size_t x = 0; x < width; ++x) line[x] = above[x] + row.next * (below[x] - above[x]);
      line[width] = line[width - 1];
      for (int x = 0; x < picture.width(); ++x) {
        if (!mask.empty() && mask(x, y) == 0) continue;
        apply(line, columns[static_cast<std::size_t>(x)], picture.pixel(x, y), highlight.pixel(x, y));
      }
    }
  });
  return highlight;
}

}  // namespace faceprobe::highlight
