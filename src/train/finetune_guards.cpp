#include "train/finetune_guards.h"

#include "faceprobe/core/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace faceprobe::train {

namespace {

constexpr int kFarPx = 4;               // what neighbours' differences are compared with
constexpr double kDarkest = 1e-3;       // of the picture; below it a share of the light is not measured
constexpr double kChromaFloor = 0.005;  // of r + g + b, as in train/chromaticity.h
constexpr double kFaintShare = 1e-3;    // of the picture's energy; highlights below it have no colour to speak of
constexpr double kPurePrimary = 2.0 / 3;

bool set(const ByteImage& mask, int x, int y) { return !mask.empty() && mask(x, y) != 0; }

double sharpness(const Image& picture, const ByteImage& usable) {
  double near = 0;
  double far = 0;
  const auto squared = [&](int x, int y, int dx, int dy) {
    const double change = static_cast<double>(luminance(picture.pixel(x + dx, y + dy)) - luminance(picture.pixel(x, y)));
    return change * change;
  };
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      for (const auto& [dx, dy] : std::array<std::array<int, 2>, 2>{{{1, 0}, {0, 1}}}) {
        const int far_x = x + kFarPx * dx;
        const int far_y = y + kFarPx * dy;
        if (far_x >= picture.width() || far_y >= picture.height()) continue;
        if (usable(x, y) == 0 || usable(far_x, far_y) == 0 || usable(x + dx, y + dy) == 0) continue;
        near += squared(x, y, dx, dy);
        far += squared(x, y, kFarPx * dx, kFarPx * dy);
      }
    }
  }
  return far > 0 ? std::sqrt(near / far) : 0.0;
}

struct Limit {
  double value, limit;
  const char* what;
};

void check(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight, const Eigen::VectorXd& weight) {
  if (picture.rows() != highlight.rows() || picture.rows() != weight.size()) {
    throw std::invalid_argument("A guard needs picture, highlight and weight of one size.");
  }
  if (!(weight.size() > 0 && weight.minCoeff() >= 0 && weight.sum() > 0)) {
    throw std::invalid_argument("A guard needs weights that are not negative and not all zero.");
  }
}

// Chromaticity (r, g) / (r + g + b) of a pixel, its channels clipped at 0, and what it was divided by.
struct Chroma {
  Eigen::RowVector2d value;
  double total;
  bool floored;
};

Chroma chroma(const Eigen::RowVector3d& colour) {
  const Eigen::RowVector3d rgb = colour.cwiseMax(0.0);
  const double total = std::max(rgb.sum(), kChromaFloor);
  return {rgb.head<2>() / total, total, rgb.sum() <= kChromaFloor};
}

Eigen::RowVector2d mean_chroma(const Eigen::MatrixX3d& diffuse, const Eigen::VectorXd& weight) {
  Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
  for (Eigen::Index i = 0; i < diffuse.rows(); ++i) sum += weight(i) * chroma(diffuse.row(i)).value;
  return sum / weight.sum();
}

}  // namespace

PhotoMeasures measure_photo(const Image& frontal, const PhotoMasks& masks) {
  const bool clipped_fits = masks.clipped.empty() || masks.clipped.same_size(frontal);
  if (frontal.channels() != 3 || !masks.skin.same_size(frontal) || !masks.seen.same_size(frontal) || !clipped_fits) {
    throw std::invalid_argument("Measuring a photo needs a colour picture and masks of its size.");
  }
  double skin = 0;
  double shown = 0;
  double clipped = 0;
  ByteImage usable(frontal.width(), frontal.height(), 1);
  for (int y = 0; y < frontal.height(); ++y) {
    for (int x = 0; x < frontal.width(); ++x) {
      if (!set(masks.skin, x, y)) continue;
      skin += 1;
      if (!set(masks.seen, x, y)) continue;
      shown += 1;
      if (set(masks.clipped, x, y)) {
        clipped += 1;
      } else {
        usable(x, y) = 255;
      }
    }
  }
  if (skin == 0) throw std::invalid_argument("Measuring a photo needs skin in the mask.");
  PhotoMeasures measures;
  measures.occluded_share = 1 - shown / skin;
  measures.clipped_share = shown > 0 ? clipped / shown : 0.0;
  measures.sharpness = sharpness(frontal, usable);
  return measures;
}

double chroma_spread(const Image& shading, const ByteImage& mask) {
  if (shading.channels() != 3 || !mask.same_size(shading)) {
    throw std::invalid_argument("The spread of light needs a colour picture and a mask of its size.");
  }
  std::vector<Eigen::Vector3d> seen;  // r and g shares, sum
  Eigen::Vector3d sums = Eigen::Vector3d::Zero();
  for (int y = 0; y < shading.height(); ++y) {
    for (int x = 0; x < shading.width(); ++x) {
      const Eigen::Vector3d rgb = Eigen::Map<const Eigen::Vector3f>(shading.pixel(x, y)).cast<double>();
      const double total = rgb.sum();
      if (!set(mask, x, y) || !(total > 0)) continue;
      seen.emplace_back(rgb(0) / total, rgb(1) / total, total);
      sums += Eigen::Vector3d(rgb(0), rgb(1), total);
    }
  }
  if (seen.empty()) return 0;
  const Eigen::Vector2d mean = sums.head<2>() / sums(2);
  double squares = 0;
  for (const Eigen::Vector3d& at : seen) squares += at(2) * (at.head<2>() - mean).squaredNorm();
  return std::sqrt(squares / sums(2));
}

std::string why_unsuitable(const PhotoMeasures& measures, const PhotoLimits& limits) {
  const std::array<Limit, 4> upper = {{
      {measures.occluded_share, limits.max_occluded_share, "much of the face is turned away or covered: a share of"},
      {measures.clipped_share, limits.max_clipped_share, "much of the skin is burnt out: a share of"},
      {measures.reprojection_share, limits.max_reprojection_share,
       "the expression is too strong to align: an error per width of the face of"},
      {measures.light_colour_spread, limits.max_light_colour_spread,
       "the lights have several colours: a spread of chromaticity of"},
  }};
  std::ostringstream why;
  why << std::setprecision(3);
  if (!(measures.sharpness >= limits.min_sharpness)) {
    why << "The photo is left out because it is not sharp: " << measures.sharpness << ", and " << limits.min_sharpness
        << " is needed.";
    return why.str();
  }
  for (const Limit& one : upper) {
    if (one.value <= one.limit) continue;  // NaN does not pass
    why << "The photo is left out because " << one.what << ' ' << one.value << ", and " << one.limit << " is allowed.";
    return why.str();
  }
  return {};
}

Penalty black_diffuse(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight, const Eigen::VectorXd& weight,
                      double least) {
  check(picture, highlight, weight);
  if (!(least > 0 && least < 1)) throw std::invalid_argument("The least share of diffuse light lies between 0 and 1.");
  Penalty penalty{0, Eigen::MatrixX3d::Zero(picture.rows(), 3)};
  const double per_value = 1 / (3 * weight.sum());
  for (Eigen::Index i = 0; i < picture.rows(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double light = std::max(picture(i, c), 0.0);
      const double unit = least * std::max(light, kDarkest);
      const double lack = (least * light - (light - highlight(i, c))) / unit;
      if (lack <= 0) continue;
      penalty.value += per_value * weight(i) * lack * lack;
      penalty.gradient(i, c) = per_value * weight(i) * 2 * lack / unit;
    }
  }
  return penalty;
}

double chroma_variance(const Eigen::MatrixX3d& diffuse, const Eigen::VectorXd& weight) {
  check(diffuse, diffuse, weight);
  const Eigen::RowVector2d mean = mean_chroma(diffuse, weight);
  double squares = 0;
  for (Eigen::Index i = 0; i < diffuse.rows(); ++i) {
    squares += weight(i) * (chroma(diffuse.row(i)).value - mean).squaredNorm();
  }
  return squares / weight.sum();
}

Penalty one_colour_diffuse(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight,
                           const Eigen::VectorXd& weight, double reference_variance, double least) {
  check(picture, highlight, weight);
  if (!(least > 0 && least < 1)) throw std::invalid_argument("The least share of variance lies between 0 and 1.");
  if (!(reference_variance > 0))
    throw std::invalid_argument("The reference's variance of chromaticity must be positive.");
  const Eigen::MatrixX3d diffuse = picture - highlight;
  Penalty penalty{0, Eigen::MatrixX3d::Zero(picture.rows(), 3)};
  const double lack = 1 - chroma_variance(diffuse, weight) / (least * reference_variance);
  if (lack <= 0) return penalty;
  penalty.value = lack * lack;
  const Eigen::RowVector2d mean = mean_chroma(diffuse, weight);
  // The mean moves too, but the sum of squares does not feel it there.
  const double by_variance = -2 * lack / (least * reference_variance);
  for (Eigen::Index i = 0; i < picture.rows(); ++i) {
    const Chroma at = chroma(diffuse.row(i));
    const Eigen::RowVector2d by_chroma = by_variance * 2 * weight(i) / weight.sum() * (at.value - mean);
    const double through_sum = at.floored ? 0.0 : by_chroma.dot(at.value);
    for (int c = 0; c < 3; ++c) {
      // Highlight up, diffuse down.
      if (diffuse(i, c) > 0) penalty.gradient(i, c) = -((c < 2 ? by_chroma(c) : 0.0) - through_sum) / at.total;
    }
  }
  return penalty;
}

Penalty coloured_highlight(const Eigen::MatrixX3d& picture, const Eigen::MatrixX3d& highlight,
                           const Eigen::VectorXd& weight, const Eigen::RowVector3d& light_colour, double most) {
  check(picture, highlight, weight);
  if (!(most >= 0 && most < kPurePrimary))
    throw std::invalid_argument("The share of coloured highlight lies in [0, 2/3).");
  if (!(light_colour.minCoeff() > 0) || !light_colour.allFinite()) {
    throw std::invalid_argument("The light's colour must be positive in every channel.");
  }
  const Eigen::RowVector3d per_light = light_colour.mean() * light_colour.cwiseInverse();
  const Eigen::MatrixX3d white = highlight * per_light.asDiagonal();
  const Eigen::MatrixX3d coloured = white.colwise() - white.rowwise().mean();
  const auto energy = [&](const Eigen::MatrixX3d& values) { return values.rowwise().squaredNorm().dot(weight); };
  const double all = energy(white) + kFaintShare * energy(picture * per_light.asDiagonal());
  Penalty penalty{0, Eigen::MatrixX3d::Zero(picture.rows(), 3)};
  if (!(all > 0)) return penalty;
  const double share = energy(coloured) / all;
  const double excess = (share - most) / (kPurePrimary - most);
  if (excess <= 0) return penalty;
  penalty.value = excess * excess;
  const double by_share = 2 * excess / (kPurePrimary - most);
  penalty.gradient = (2 * by_share / all) * (weight.asDiagonal() * (coloured - share * white)) * per_light.asDiagonal();
  return penalty;
}

}  // namespace faceprobe::train
