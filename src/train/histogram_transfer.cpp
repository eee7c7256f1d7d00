#include "train/histogram_transfer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {

namespace {

// Of all values, spread evenly over the bins. Far below the share of a single pixel, so that outliers keep their
// places; and 1e-9 per bin is still far above double's rounding.
constexpr double kUniformShare = 1e-6;

// The histogram's axis: near to what files encode, exact to invert, and defined below zero.
double axis_from_linear(double linear) { return std::copysign(std::sqrt(std::abs(linear)), linear); }
double linear_from_axis(double axis) { return axis * std::abs(axis); }

struct Axis {
  double low, bin_width;
  int bins;
};

// Share of the values below each edge of the bins; from 0 to 1, strictly increasing.
std::vector<double> cumulative(const std::vector<float>& values, const Axis& axis) {
  std::vector<double> count(static_cast<std::size_t>(axis.bins));
  for (const float value : values) {
    const double at = (axis_from_linear(static_cast<double>(value)) - axis.low) / axis.bin_width;
    count[static_cast<std::size_t>(std::clamp(static_cast<int>(at), 0, axis.bins - 1))] += 1;
  }
  std::vector<double> below(count.size() + 1);
  const double per_value = (1 - kUniformShare) / static_cast<double>(values.size());
  for (std::size_t i = 0; i < count.size(); ++i)
    below[i + 1] = below[i] + per_value * count[i] + kUniformShare / axis.bins;
  for (double& share : below) share /= below.back();
  return below;
}

std::vector<float> inside(const Image& picture, const ByteImage& mask, int channel) {
  std::vector<float> values;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (mask.empty() || mask(x, y) != 0) values.push_back(picture(x, y, channel));
    }
  }
  return values;
}

void check_mask(const Image& picture, const ByteImage& mask) {
  if (!mask.empty() && (!mask.same_size(picture) || mask.channels() != 1)) {
    throw std::invalid_argument("A histogram's mask needs the size of its picture and one channel.");
  }
}

}  // namespace

std::string HistogramTransferOptions::validate() const {
  if (bins < 256 || bins > 65536) return "bins must be from 256 to 65536.";
  return {};
}

HistogramCurve::HistogramCurve(const std::vector<float>& values, const std::vector<float>& reference, int bins) {
  if (values.empty() || reference.empty()) throw std::invalid_argument("A histogram needs pixels inside its mask.");
  for (const std::vector<float>* set : {&values, &reference}) {
    if (!std::all_of(set->begin(), set->end(), [](float v) { return std::isfinite(v); })) {
      throw std::invalid_argument("A histogram needs finite values.");
    }
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const auto [reference_low, reference_high] = std::minmax_element(reference.begin(), reference.end());
  low_ = axis_from_linear(static_cast<double>(std::min(*low, *reference_low)));
  const double range = axis_from_linear(static_cast<double>(std::max(*high, *reference_high))) - low_;
  // The extremes lie in the middle of the outermost bins: at an edge they would stay where they are.
  bin_width_ = std::max(range, 1e-9) / (bins - 1);  // one value only: any width will do
  low_ -= 0.5 * bin_width_;
  const Axis axis{low_, bin_width_, bins};
  from_ = cumulative(values, axis);
  to_ = cumulative(reference, axis);
}

double HistogramCurve::operator()(double linear) const {
  const double bins = static_cast<double>(from_.size() - 1);
  const double at = (axis_from_linear(linear) - low_) / bin_width_;
  if (at <= 0 || at >= bins) return linear;  // both distributions start at the lowest edge and end at the highest
  const auto bin = static_cast<std::size_t>(at);
  const double share = from_[bin] + (at - static_cast<double>(bin)) * (from_[bin + 1] - from_[bin]);
  const auto above = std::upper_bound(to_.begin() + 1, to_.end() - 1, share);
  const auto end = static_cast<std::size_t>(above - to_.begin());
  const double within = (share - to_[end - 1]) / (to_[end] - to_[end - 1]);
  return linear_from_axis(low_ + bin_width_ * (static_cast<double>(end - 1) + within));
}

Image transfer_histogram(const Image& picture, const ByteImage& mask, const Image& reference,
                         const ByteImage& reference_mask, const HistogramTransferOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  check_mask(picture, mask);
  check_mask(reference, reference_mask);
  if (picture.channels() != reference.channels()) {
    throw std::invalid_argument("Histogram transfer needs pictures with the same number of channels.");
  }
  Image matched = picture;
  for (int c = 0; c < picture.channels(); ++c) {
    const HistogramCurve curve(inside(picture, mask, c), inside(reference, reference_mask, c), options.bins);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        if (!mask.empty() && mask(x, y) == 0) continue;
        matched(x, y, c) = static_cast<float>(curve(static_cast<double>(picture(x, y, c))));
      }
    }
  }
  return matched;
}

}  // namespace faceprobe::train
