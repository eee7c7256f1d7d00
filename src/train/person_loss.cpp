#include "train/person_loss.h"

#include "train/finetune_guards.h"
#include "train/low_rank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr double kLeastEnergy = 1e-3;  // a photo without highlights does not forbid them
// Of chromaticity; a deviation of a thousandth is that of a photo's rounding to bytes. Skin without more has no colours to lose.
constexpr double kLeastVariance = 1e-6;

// Where a skin pixel of the square is seen, unclipped, by every photo.
Image common_skin(const std::vector<PersonPhoto>& photos, const ByteImage& regions) {
  Image weight(regions.width(), regions.height(), 1);
  for (std::size_t i = 0; i < weight.pixel_count(); ++i)
    weight.data()[i] = is_probe_skin(static_cast<Region>(regions.data()[i])) ? 1.0F : 0.0F;
  for (const PersonPhoto& photo : photos) {
    const ByteImage shown = seen(photo.warp);
    Image clipped(photo.linear.width(), photo.linear.height(), 1);
    for (std::size_t i = 0; !photo.clipped.empty() && i < clipped.pixel_count(); ++i)
      clipped.data()[i] = photo.clipped.data()[i] != 0 ? 1.0F : 0.0F;
    const Image flat = sample(clipped, photo.warp);
    for (std::size_t i = 0; i < weight.pixel_count(); ++i) {
      if (shown.data()[i] == 0 || flat.data()[i] > 0) weight.data()[i] = 0;
    }
  }
  return weight;
}

void check(const std::vector<PersonPhoto>& photos, const ByteImage& regions) {
  if (photos.size() < 2) throw std::invalid_argument("The low-rank loss compares two photos or more.");
  for (const PersonPhoto& photo : photos) {
    const bool fits = photo.linear.channels() == 3 && photo.warp.photo.width == photo.linear.width() &&
                      photo.warp.photo.height == photo.linear.height() && photo.warp.size_px == regions.width() &&
                      (photo.clipped.empty() || photo.clipped.same_size(photo.linear));
    if (!fits) throw std::invalid_argument("A person's photo, its flags and its warp must fit one another.");
  }
}

void check(const LayerMeasures& trusted, std::size_t photos) {
  for (const std::vector<double>* one : {&trusted.energies, &trusted.chroma_variances}) {
    if (!one->empty() && one->size() != photos)
      throw std::invalid_argument("One trusted number per photo is wanted, or none.");
  }
}

// 0 when it is not known, or too small to be held to.
double reference_variance(const LayerMeasures& trusted) {
  if (trusted.chroma_variances.empty()) return 0;
  const double least = *std::ranges::min_element(trusted.chroma_variances);
  return least > kLeastVariance ? least : 0;
}

}  // namespace

std::string PersonLossOptions::validate() const {
  if (!(blur_sigma_px >= 0 && blur_sigma_px <= 32)) return "blur_sigma_px must be 0 to 32.";
  if (!(energy_weight >= 0 && energy_weight <= 100)) return "energy_weight must be 0 to 100.";
  if (!(guard_weight >= 0 && guard_weight <= 100)) return "guard_weight must be 0 to 100.";
  return {};
}

PersonPhotos::PersonPhotos(std::vector<PersonPhoto> photos, const ByteImage& regions, const PersonLossOptions& options)
    : photos_(std::move(photos)), options_(options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  check(photos_, regions);
  weight_ = common_skin(photos_, regions);
  chromaticity_.emplace(weight_, ChromaticityOptions{.blur_sigma_px = options.blur_sigma_px});
  for (const PersonPhoto& photo : photos_) flat_.push_back(matrix_from_picture(sample(photo.linear, photo.warp)));
}

PersonLoss PersonPhotos::loss(std::span<const Image> highlights, const LayerMeasures& trusted) const {
  if (highlights.size() != photos_.size()) throw std::invalid_argument("One highlight layer per photo is wanted.");
  check(trusted, photos_.size());
  std::vector<Eigen::MatrixX3d> flat_highlight;
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(photos_.size()), 2 * chromaticity_->pixels());
  for (std::size_t k = 0; k < photos_.size(); ++k) {
    if (!highlights[k].same_size(photos_[k].linear) || highlights[k].channels() != 3)
      throw std::invalid_argument("A highlight layer has the size of its photo.");
    flat_highlight.push_back(matrix_from_picture(sample(highlights[k], photos_[k].warp)));
    rows.row(static_cast<Eigen::Index>(k)) = chromaticity_->row(flat_[k] - flat_highlight[k]);
  }
  const double pixels = chromaticity_->weight_sum();
  const LowRankLoss low_rank = options_.rank1 ? distance_to_rank1(rows, pixels) : sigma2(rows, pixels);
  const Eigen::Map<const Eigen::VectorXf> weight(weight_.data(), static_cast<Eigen::Index>(weight_.pixel_count()));
  const Eigen::VectorXd mask = weight.cast<double>();

  const auto photo_count = static_cast<double>(photos_.size());
  const double variance = reference_variance(trusted);
  PersonLoss out;
  out.residual = low_rank.value;
  for (std::size_t k = 0; k < photos_.size(); ++k) {
    // The diffuse layer is the photo less the highlight, hence the sign.
    Eigen::MatrixX3d by_flat =
        -chromaticity_->backward(flat_[k] - flat_highlight[k], low_rank.gradient.row(static_cast<Eigen::Index>(k)));
    const auto guard_by = [&](const Penalty& guard) {
      out.guards += options_.guard_weight * guard.value;
      by_flat += options_.guard_weight * guard.gradient;
    };
    if (options_.guard_weight > 0) {
      guard_by(black_diffuse(flat_[k], flat_highlight[k], mask));
      guard_by(coloured_highlight(flat_[k], flat_highlight[k], mask));
      if (variance > 0) guard_by(one_colour_diffuse(flat_[k], flat_highlight[k], mask, variance));
    }
    const double energy = mask.dot(flat_highlight[k].rowwise().mean()) / pixels;
    out.measures.energies.push_back(energy);
    out.measures.chroma_variances.push_back(chroma_variance(flat_[k] - flat_highlight[k], mask));
    out.energy += energy / photo_count;
    if (!trusted.energies.empty() && options_.energy_weight > 0) {
      const double usual = std::max(trusted.energies[k], kLeastEnergy);
      const double excess = energy / usual - 1;
      out.kept += options_.energy_weight * excess * excess / photo_count;
      const double slope = 2 * options_.energy_weight * excess / usual / photo_count;
      by_flat.colwise() += slope / (3 * pixels) * mask;
    }
    out.by_highlight.push_back(
        scatter(picture_from_matrix(by_flat, photos_[k].warp.size_px, photos_[k].warp.size_px), photos_[k].warp));
  }
  return out;
}

}  // namespace faceprobe::train
