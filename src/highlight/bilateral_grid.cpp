#include "highlight/bilateral_grid.h"

#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace faceprobe::highlight {
namespace {

// Four cells to one sigma: linear spreading and reading add 1/6 cell^2 each to a variance of 16, about 2 %, taken off
// below.
constexpr float kCellsPerSigma = 4;
constexpr int kBlurRadius = 12;    // three sigma
constexpr int kRowsPerBlock = 32;  // spread into one partial grid; fixed, so that sums do not depend on the threads

// Position on an axis split into the cell below and the share of the next one.
struct Slot {
  std::size_t cell;
  float next;
};
Slot slot(float position, int cells) {
  const float inside = std::clamp(position, 0.0F, static_cast<float>(cells - 2));
  const int cell = std::min(static_cast<int>(inside), cells - 2);
  return {static_cast<std::size_t>(cell), std::clamp(position - static_cast<float>(cell), 0.0F, 1.0F)};
}

std::array<float, 2 * kBlurRadius + 1> blur_kernel() {
  const float variance = kCellsPerSigma * kCellsPerSigma - 2.0F / 6.0F;
  std::array<float, 2 * kBlurRadius + 1> kernel;
  for (int i = -kBlurRadius; i <= kBlurRadius; ++i) {
    kernel[static_cast<std::size_t>(i + kBlurRadius)] = std::exp(-0.5F * static_cast<float>(i * i) / variance);
  }
  return kernel;
}

// Blurs the lines of `cells` values that begin at line_starts; element i of a line lies at start + i * step.
void blur_axis(std::vector<float>* values, int cells, std::size_t step, const std::vector<std::size_t>& line_starts) {
  static const std::array<float, 2 * kBlurRadius + 1> kKernel = blur_kernel();
  std::vector<float> line(static_cast<std::size_t>(cells));
  for (const std::size_t start : line_starts) {
    for (int i = 0; i < cells; ++i)
      line[static_cast<std::size_t>(i)] = (*values)[start + static_cast<std::size_t>(i) * step];
    for (int i = 0; i < cells; ++i) {
      float sum = 0;
      for (int j = std::max(0, i - kBlurRadius); j <= std::min(cells - 1, i + kBlurRadius); ++j) {
        sum += line[static_cast<std::size_t>(j)] * kKernel[static_cast<std::size_t>(j - i + kBlurRadius)];
      }
      (*values)[start + static_cast<std::size_t>(i) * step] = sum;
    }
  }
}

}  // namespace

BilateralGrid::BilateralGrid(const Image& guide, const BilateralSigmas& sigmas, int threads)
    : guide_(guide), threads_(threads) {
  float low = 1;
  float high = 0;
  for (const float value : guide.values()) {
    if (value < 0) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  guide_low_ = low;
  const auto axis = [](float length, float sigma) {
    const float per_unit = kCellsPerSigma / sigma;
    return Axis{static_cast<int>(std::max(0.0F, length) * per_unit) + 2, per_unit};
  };
  x_ = axis(static_cast<float>(guide.width() - 1), sigmas.spatial);
  y_ = axis(static_cast<float>(guide.height() - 1), sigmas.spatial);
  z_ = axis(high - low, sigmas.range);
  weights_ = spread([](int, int) { return 1.0F; });
  blur(&weights_);
}

template <class ValueAt>
BilateralGrid::Cells BilateralGrid::spread(const ValueAt& value_at) const {
  const int height = guide_.height();
  const int blocks = (height + kRowsPerBlock - 1) / kRowsPerBlock;
  const std::size_t plane = plane_size();
  const std::size_t depth = static_cast<std::size_t>(z_.cells);
  std::vector<Cells> partial(static_cast<std::size_t>(blocks));
  // A block touches few grid rows when pixels are many: keep only those.
  const auto first_row = [&](int block) {
    return slot(static_cast<float>(block * kRowsPerBlock) * y_.per_unit, y_.cells).cell;
  };
  const auto last_row = [&](int block) {
    const int y = std::min(height, (block + 1) * kRowsPerBlock) - 1;
    return slot(static_cast<float>(y) * y_.per_unit, y_.cells).cell + 1;
  };
  parallel_for(blocks, threads_, [&](int first, int last) {
    Cells line(plane);
    for (int block = first; block < last; ++block) {
      Cells& cells = partial[static_cast<std::size_t>(block)];
      cells.assign((last_row(block) - first_row(block) + 1) * plane, 0.0F);
      for (int y = block * kRowsPerBlock; y < std::min(height, (block + 1) * kRowsPerBlock); ++y) {
        std::fill(line.begin(), line.end(), 0.0F);
        for (int x = 0; x < guide_.width(); ++x) {
          const float guide = guide_(x, y);
          if (guide < 0) continue;
          const Slot sx = slot(static_cast<float>(x) * x_.per_unit, x_.cells);
          const Slot sz = slot((guide - guide_low_) * z_.per_unit, z_.cells);
          const float value = value_at(x, y);
          float* cell = line.data() + sx.cell * depth + sz.cell;
          cell[0] += value * (1 - sx.next) * (1 - sz.next);
          cell[1] += value * (1 - sx.next) * sz.next;
          cell[depth] += value * sx.next * (1 - sz.next);
          cell[depth + 1] += value * sx.next * sz.next;
        }
        const Slot sy = slot(static_cast<float>(y) * y_.per_unit, y_.cells);
        float* below = cells.data() + (sy.cell - first_row(block)) * plane;
        for (std::size_t i = 0; i < plane; ++i) {
          below[i] += line[i] * (1 - sy.next);
          below[plane + i] += line[i] * sy.next;
        }
      }
    }
  });
  Cells sum(static_cast<std::size_t>(y_.cells) * plane);
  for (int block = 0; block < blocks; ++block) {
    const Cells& cells = partial[static_cast<std::size_t>(block)];
    float* to = sum.data() + first_row(block) * plane;
    for (std::size_t i = 0; i < cells.size(); ++i) to[i] += cells[i];
  }
  return sum;
}

void BilateralGrid::blur(Cells* cells) const {
  const std::size_t plane = plane_size();
  const auto depth = static_cast<std::size_t>(z_.cells);
  const auto width = static_cast<std::size_t>(x_.cells);
  const auto height = static_cast<std::size_t>(y_.cells);
  std::vector<std::size_t> starts;
  for (std::size_t i = 0; i < height * width; ++i) starts.push_back(i * depth);
  blur_axis(cells, z_.cells, 1, starts);
  starts.clear();
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t z = 0; z < depth; ++z) starts.push_back(y * plane + z);
  }
  blur_axis(cells, x_.cells, depth, starts);
  starts.clear();
  for (std::size_t i = 0; i < plane; ++i) starts.push_back(i);
  blur_axis(cells, y_.cells, plane, starts);
}

Image BilateralGrid::filter(const Image& values) const {
  Cells cells = spread([&](int x, int y) { return values(x, y); });
  blur(&cells);
  Image out(guide_.width(), guide_.height(), 1);
  const std::size_t plane = plane_size();
  const auto depth = static_cast<std::size_t>(z_.cells);
  parallel_for(guide_.height(), threads_, [&](int first, int last) {
    Cells sum(plane);
    Cells weight(plane);
    for (int y = first; y < last; ++y) {
      const Slot sy = slot(static_cast<float>(y) * y_.per_unit, y_.cells);
      const std::size_t at = sy.cell * plane;
      for (std::size_t i = 0; i < plane; ++i) {
        sum[i] = cells[at + i] * (1 - sy.next) + cells[at + plane + i] * sy.next;
        weight[i] = weights_[at + i] * (1 - sy.next) + weights_[at + plane + i] * sy.next;
      }
      for (int x = 0; x < guide_.width(); ++x) {
        const float guide = guide_(x, y);
        if (guide < 0) continue;
        const Slot sx = slot(static_cast<float>(x) * x_.per_unit, x_.cells);
        const Slot sz = slot((guide - guide_low_) * z_.per_unit, z_.cells);
        const std::size_t cell = sx.cell * depth + sz.cell;
        const auto read = [&](const Cells& from) {
          const float near = from[cell] * (1 - sz.next) + from[cell + 1] * sz.next;
          const float far = from[cell + depth] * (1 - sz.next) + from[cell + depth + 1] * sz.next;
          return near * (1 - sx.next) + far * sx.next;
        };
        out(x, y) = read(sum) / read(weight);  // the pixel itself is in the grid: the weight is above zero
      }
    }
  });
  return out;
}

}  // namespace faceprobe::highlight
