#include "faceprobe/lighting/albedo.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "lighting/region_luminance.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace faceprobe::lighting {

namespace {

// ESTIMATES. Skin locus in linear Rec.709 from light (r/g 1.8, b/g .74) over medium (2.4, .56) to dark skin (2.7, .54).
const Eigen::Array2d kSkinLogRatio(std::log(2.2), std::log(0.60));  // mean of log(r/g), log(b/g)
constexpr double kSkinSigma = 0.20;                                 // scatter of people along and across the locus
constexpr double kWhiteBalanceSigma = 0.12;  // what a camera's white balance leaves of the light's colour
constexpr int kMostSamples = 3000;           // pixels that the light is fitted to; more say the same

struct Mean {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double count = 0;
  void add(const float* rgb) {
    sum += Eigen::Map<const Eigen::Array3f>(rgb).cast<double>();
    count += 1;
  }
};

Eigen::Vector3f with_luminance(const Eigen::Array3d& colour, float luminance) {
  return (colour * (luminance / faceprobe::luminance(colour.data()))).matrix().cast<float>();
}

// Radians of angle a unit of error in log(r/g) and log(b/g): of d colour what is across the colour.
double turn_per_log(const Eigen::Vector3f& colour) {
  const Eigen::Array3d squares = colour.cast<double>().array().square();
  const Eigen::Array3d share = squares / squares.sum();
  return std::sqrt(share[0] * (1 - share[0]) + share[2] * (1 - share[2]));
}

// One pass of a running mean along rows or columns, borders clamped; three make a near-Gaussian.
void box_blur(Image& image, int radius, bool along_rows) {
  const int length = along_rows ? image.width() : image.height();
  const int lines = along_rows ? image.height() : image.width();
  std::vector<float> line(static_cast<std::size_t>(length));
  for (int l = 0; l < lines; ++l) {
    for (int c = 0; c < image.channels(); ++c) {
      const auto at = [&](int i) -> float& {
        i = std::clamp(i, 0, length - 1);
        return along_rows ? image(i, l, c) : image(l, i, c);
      };
      float sum = 0;
      for (int i = -radius; i <= radius; ++i) sum += at(i);
      for (int i = 0; i < length; ++i) {
        line[static_cast<std::size_t>(i)] = sum / static_cast<float>(2 * radius + 1);
        sum += at(i + radius + 1) - at(i - radius);
      }
      for (int i = 0; i < length; ++i) at(i) = line[static_cast<std::size_t>(i)];
    }
  }
}

// Skin that is not clipped, evenly over the picture.
RegionSamples samples_of(const Image& diffuse, const ByteImage& skin_region, const ByteImage& clipped,
                         const Image& normal_cam) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < skin_region.pixel_count(); ++i) {
    const auto region = static_cast<Region>(skin_region.data()[i]);
    const Eigen::Map<const Eigen::Vector3f> normal(normal_cam.data() + 3 * i);
    if (is_skin(region) && clipped.data()[i] == 0 && normal.norm() > 0.5F) places.push_back(i);
  }
  const std::size_t step = places.size() / kMostSamples + 1;
  RegionSamples samples;
  const auto count = static_cast<Eigen::Index>((places.size() + step - 1) / step);
  samples.normal.resize(count, 3);
  samples.luminance.resize(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const std::size_t i = places[static_cast<std::size_t>(k) * step];
    samples.normal.row(k) = Eigen::Map<const Eigen::RowVector3f>(normal_cam.data() + 3 * i).normalized();
    const float* rgb = diffuse.data() + 3 * i;
    samples.luminance[k] = luminance(rgb[0], rgb[1], rgb[2]);
    samples.region.push_back(static_cast<Region>(skin_region.data()[i]));
  }
  return samples;
}

}  // namespace

SkinColourPrior skin_colour_prior() { return {kSkinLogRatio, kSkinSigma}; }

double colour_uncertainty_deg(const Eigen::Vector3f& colour, double log_deviation) {
  return degrees(log_deviation * turn_per_log(colour));
}

double colour_log_deviation(const Eigen::Vector3f& colour, double uncertainty_deg) {
  return radians(uncertainty_deg) / turn_per_log(colour);
}

AlbedoModel fit_albedo(const Image& diffuse, const ByteImage& skin_region, const ByteImage& clipped,
                       const Image& normal_cam, bool grey) {
  const bool has_normals = !normal_cam.empty();
  if (!diffuse.same_size(skin_region) || !diffuse.same_size(clipped) || diffuse.channels() != 3 ||
      (has_normals && (!normal_cam.same_size(skin_region) || normal_cam.channels() != 3))) {
    throw std::invalid_argument(
        "Albedo needs a three-channel diffuse layer, region and clip maps of its size, and normals of that size or "
        "none.");
  }
  std::array<Mean, kSkinRegionCount> regions;
  Mean all;
  for (int y = 0; y < diffuse.height(); ++y) {
    for (int x = 0; x < diffuse.width(); ++x) {
      const auto region = static_cast<Region>(skin_region(x, y));
      if (!is_skin(region) || clipped(x, y) != 0) continue;
      const float* rgb = diffuse.pixel(x, y);
      regions[static_cast<std::size_t>(region) - 1].add(rgb);
      if (is_probe_skin(region)) all.add(rgb);  // lips and brows have colours of their own
    }
  }
  AlbedoModel model;
  const Eigen::Array3d prior_skin = grey ? Eigen::Array3d::Ones().eval()
                                         : Eigen::Array3d(std::exp(kSkinLogRatio[0]), 1.0, std::exp(kSkinLogRatio[1]));
  model.light_colour.setOnes();
  constexpr double kLightVariance = kWhiteBalanceSigma * kWhiteBalanceSigma;
  if (!grey) model.light_colour_uncertainty_deg = colour_uncertainty_deg(model.light_colour, kWhiteBalanceSigma);
  RelativeLuminance relative = usual_relative_luminance();
  for (std::size_t r = 0; r < relative.size(); ++r)
    model.region_albedo[r] = with_luminance(prior_skin, kSkinLuminance * relative[r]);
  if (all.count < 1 || !(all.sum.minCoeff() > 0)) return model;

  // log(product) = log(light) + log(skin); posterior mean of the first under two independent normal priors.
  const Eigen::Array2d found(std::log(all.sum[0] / all.sum[1]), std::log(all.sum[2] / all.sum[1]));
  constexpr double kSkinShare = kSkinSigma * kSkinSigma / (kLightVariance + kSkinSigma * kSkinSigma);
  const Eigen::Array2d log_light =
      grey ? Eigen::Array2d::Zero().eval()
           : ((found - kSkinLogRatio) * (kLightVariance / (kLightVariance + kSkinSigma * kSkinSigma))).eval();
  const Eigen::Array3d light(std::exp(log_light[0]), 1.0, std::exp(log_light[1]));
  model.light_colour = light.matrix().cast<float>();
  if (!grey)
    model.light_colour_uncertainty_deg =
        colour_uncertainty_deg(model.light_colour, std::sqrt(kLightVariance * kSkinShare));
  if (has_normals) relative = fit_relative_luminance(samples_of(diffuse, skin_region, clipped, normal_cam));
  for (std::size_t r = 0; r < regions.size(); ++r) {
    // Regions of few pixels lean on the whole face.
    constexpr double kLeast = 50;
    const Eigen::Array3d mean = regions[r].sum + kLeast * all.sum / all.count;
    if (!(mean.minCoeff() > 0)) continue;
    model.region_albedo[r] = with_luminance(mean / light, kSkinLuminance * relative[r]);
  }
  return model;
}

Image albedo_picture(const AlbedoModel& model, const ByteImage& skin_region) {
  const Eigen::Vector3f elsewhere = model.region_albedo[static_cast<std::size_t>(Region::kCheeks) - 1];
  Image albedo(skin_region.width(), skin_region.height(), 3);
  for (int y = 0; y < albedo.height(); ++y) {
    for (int x = 0; x < albedo.width(); ++x) {
      const auto region = static_cast<Region>(skin_region(x, y));
      Eigen::Map<Eigen::Vector3f>(albedo.pixel(x, y)) =
          is_skin(region) ? model.region_albedo[static_cast<std::size_t>(region) - 1] : elsewhere;
    }
  }
  const int radius = std::max(1, std::max(albedo.width(), albedo.height()) / 100);
  for (int pass = 0; pass < 3; ++pass) {
    box_blur(albedo, radius, true);
    box_blur(albedo, radius, false);
  }
  return albedo;
}

}  // namespace faceprobe::lighting
