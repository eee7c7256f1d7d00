#include "pipeline/same_person.h"

#include "faceprobe/core/color.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/pipeline/observe.h"
#include "pipeline/light_result.h"

#include <array>
#include <cmath>

namespace faceprobe::pipeline {

namespace {

constexpr double kLeastPixels = 50;  // of a region, to say anything; it leans on the whole face with as many

struct Sums {
  Eigen::Vector3d diffuse = Eigen::Vector3d::Zero();
  Eigen::Vector3d shading = Eigen::Vector3d::Zero();
  double pixels = 0;
};

std::array<Sums, kSkinRegionCount> region_sums(const FaceEstimate& face) {
  std::array<Sums, kSkinRegionCount> sums;
  const ByteImage& region = face.geometry.region;
  for (std::size_t i = 0; i < region.pixel_count(); ++i) {
    const int r = region.data()[i];
    if (r < 1 || r > kSkinRegionCount || face.clipped.data()[i] != 0) continue;
    Sums& own = sums[static_cast<std::size_t>(r - 1)];
    own.diffuse += Eigen::Map<const Eigen::Vector3f>(face.layers.diffuse.data() + 3 * i).cast<double>();
    own.shading += Eigen::Map<const Eigen::Vector3f>(face.shading.data() + 3 * i).cast<double>();
    own.pixels += 1;
  }
  return sums;
}

double total_shading(const lighting::Observations& o) {
  return static_cast<double>(o.weight.dot(o.shading * kLuminanceWeights));
}

bool is_one(const Eigen::Vector3f& gain) { return (gain.array() - 1).abs().maxCoeff() < 1e-5F; }

// Photos that agree already keep their lights to the last bit.
bool changes(const lighting::SharedSkin::Photo& photo) {
  for (const Eigen::Vector3f& gain : photo.region_gain) {
    if (!is_one(gain)) return true;
  }
  return !is_one(photo.gain);
}

// Highlights over shading, by the fit of this face's light; nothing where there was nothing to fit.
std::optional<double> fitted_gain(const FaceEstimate& face, const EstimateOptions& options) {
  const bool fitted = options.solve.solver == lighting::Solver::kTransport && options.solve.fit_highlight_gain;
  if (!fitted || !face.light.highlight_residual || !lighting::shows_highlights(face.observations)) return std::nullopt;
  return static_cast<double>(face.light.highlight_gain);
}

}  // namespace

std::optional<lighting::SkinReading> skin_reading(const FaceEstimate& face) {
  const std::optional<Eigen::Vector3f> mean = mean_skin_albedo(face);
  if (!mean || !(mean->minCoeff() > 0)) return std::nullopt;
  lighting::SkinReading reading;
  reading.albedo = *mean;
  reading.grey = face.observations.grey;
  if (face.light_colour_uncertainty_deg && *face.light_colour_uncertainty_deg > 0) {
    // Light times skin is what the photo shows: the one is as uncertain as the other.
    reading.log_deviation = lighting::colour_log_deviation(face.light_colour, *face.light_colour_uncertainty_deg);
    reading.has_prior = true;
  }
  const std::array<Sums, kSkinRegionCount> sums = region_sums(face);
  for (std::size_t r = 0; r < sums.size(); ++r) {
    if (sums[r].pixels < kLeastPixels || !(sums[r].shading.minCoeff() > 0)) continue;
    const Eigen::Vector3d lean = sums[r].shading * (kLeastPixels / sums[r].pixels);
    const Eigen::Vector3d diffuse = sums[r].diffuse + lean.cwiseProduct(mean->cast<double>());
    reading.region_albedo[r] = diffuse.cwiseQuotient(sums[r].shading + lean).cast<float>();
  }
  return reading;
}

void apply_skin_gain(const lighting::SharedSkin::Photo& gain, double skin_log_deviation, const EstimateOptions& options,
                     FaceEstimate& face) {
  const ByteImage skin = skin_regions(face.geometry.region);
  lighting::AlbedoModel gains;
  gains.region_albedo = gain.region_gain;
  const Image picture = lighting::albedo_picture(gains, skin);  // soft across the regions' borders
  for (std::size_t i = 0; i < picture.values().size(); ++i) {
    face.shading.data()[i] *= picture.data()[i];
    face.albedo.data()[i] /= picture.data()[i];
  }
  const Eigen::Vector3f colour = face.light_colour.cwiseProduct(gain.gain);
  if (colour.y() > 0) face.light_colour = colour / colour.y();
  if (face.light_colour_uncertainty_deg)
    face.light_colour_uncertainty_deg = lighting::colour_uncertainty_deg(face.light_colour, skin_log_deviation);
  const lighting::Observations before = std::move(face.observations);
  face.observations =
      observe(face.geometry, face.layers.highlight, face.shading, face.clipped, options.max_patches, options.threads);
  face.observations.grey = before.grey;
  // The same patches: what the skin is darker, the light is brighter.
  if (before.open_shading.rows() > 0) {
    face.observations.open_shading =
        before.open_shading.cwiseProduct(face.observations.shading.cwiseQuotient(before.shading.cwiseMax(1e-6F)));
  }
}

void share_person(const std::vector<FaceEstimate*>& faces, const EstimateOptions& options, const SolveAgain& solve) {
  std::vector<FaceEstimate*> lit_faces;
  std::vector<lighting::SkinReading> readings;
  for (FaceEstimate* face : faces) {
    std::optional<lighting::SkinReading> reading = skin_reading(*face);
    if (!reading) continue;
    lit_faces.push_back(face);
    readings.push_back(*std::move(reading));
  }
  if (lit_faces.size() < 2) return;
  const lighting::SharedSkin skin = lighting::share_skin(readings);
  std::vector<double> own_gains(lit_faces.size(), 0);
  std::vector<double> gains;
  std::vector<bool> changed;
  for (std::size_t i = 0; i < lit_faces.size(); ++i) {
    FaceEstimate& face = *lit_faces[i];
    const lighting::SharedSkin::Photo& photo = skin.photos[i];
    const std::optional<double> gain = fitted_gain(face, options);
    const double before = total_shading(face.observations);
    changed.push_back(changes(photo));
    if (changed.back()) apply_skin_gain(photo, skin.log_deviation, options, face);
    face.same_person = SamePerson{lit_faces.size(), photo.gain, skin.albedo, photo.trust};
    if (!gain || !(before > 0)) continue;
    // The fit compares highlights with shading: of a shading twice as bright it would have been half.
    own_gains[i] = *gain * before / total_shading(face.observations);
    gains.push_back(own_gains[i]);
  }
  lighting::SolveOptions how = options.solve;
  const double shared = lighting::shared_gain(gains);
  for (std::size_t i = 0; i < lit_faces.size(); ++i) {
    how.fit_highlight_gain = options.solve.fit_highlight_gain && own_gains[i] == 0;
    if (own_gains[i] > 0) {
      how.highlight_gain = static_cast<float>(shared);
      if (!changed[i] && std::abs(own_gains[i] / shared - 1) < 1e-5) continue;
    } else if (!changed[i]) {
      continue;
    }
    FaceEstimate& face = *lit_faces[i];
    static_cast<LightResult&>(face) =
        solved_light(solve(face.observations, face.enough_shown, how), face.observations, options);
  }
}

}  // namespace faceprobe::pipeline
