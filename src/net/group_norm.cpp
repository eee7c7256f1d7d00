#include "net/group_norm.h"

#include "net/unet_options.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace faceprobe::net {
namespace {

// Always the same instructions, wherever in memory the numbers lie: Eigen's own loops over runs of any length begin and end with others,
// whose exponential differs in the last bit.
constexpr int kPack = 8;
using Pack = Eigen::Array<float, kPack, 1>;
static_assert(kNormGroups % kPack == 0, "every width is a multiple of the groups");

}  // namespace

GroupNormSilu::GroupNormSilu(WeightList& weights, const std::string& name, int channels)
    : weight_(weights.take(name + ".weight", {channels})), bias_(weights.take(name + ".bias", {channels})) {}

void GroupNormSilu::apply(Image& features) const {
  const int channels = features.channels();
  const double count = static_cast<double>(features.pixel_count()) * channels / kNormGroups;
  // Sums of a row in float, of the rows in double: enough to tell the two sums apart for any picture.
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(channels);
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(channels);
  for (int y = 0; y < features.height(); ++y) {
    for (int c = 0; c < channels; c += kPack) {
      Pack row = Pack::Zero();
      Pack row_squares = Pack::Zero();
      for (int x = 0; x < features.width(); ++x) {
        const Pack values = Eigen::Map<const Pack>(features.pixel(x, y) + c);
        row += values;
        row_squares += values * values;
      }
      sum.segment<kPack>(c) += row.cast<double>();
      squares.segment<kPack>(c) += row_squares.cast<double>();
    }
  }
  std::vector<float> scale(weight_.size());
  std::vector<float> shift(weight_.size());
  const int size = channels / kNormGroups;
  for (int begin = 0; begin < channels; begin += size) {
    const double mean = sum.segment(begin, size).sum() / count;
    const double variance = std::max(0.0, squares.segment(begin, size).sum() / count - mean * mean);
    const double root = std::sqrt(variance + static_cast<double>(kNormFloor));
    for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(begin + size); ++c) {
      scale[c] = static_cast<float>(static_cast<double>(weight_[c]) / root);
      shift[c] = bias_[c] - static_cast<float>(mean) * scale[c];
    }
  }
  for (int y = 0; y < features.height(); ++y) {
    for (int x = 0; x < features.width(); ++x) {
      for (int c = 0; c < channels; c += kPack) {
        Eigen::Map<Pack> values(features.pixel(x, y) + c);
        const Pack normal =
            Pack(values) * Eigen::Map<const Pack>(scale.data() + c) + Eigen::Map<const Pack>(shift.data() + c);
        const Pack grown = (-normal).exp();
        values = normal / (1.0F + grown);
      }
    }
  }
}

}  // namespace faceprobe::net
