// Albedo = target tone x what the texture deviates from its own mean, in logarithms, where layers of pigment add up. The deviation is
// split along the axes of melanin and haemoglobin and a remainder (hair, make-up, noise). Redness shows less under much melanin
// (tone.h says how much less) and lips hold less melanin than the skin around them; brows, stubble and moles keep their contrast.

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/synth/skin.h"
#include "synth/skin/marks.h"
#include "synth/skin/texture.h"
#include "synth/skin/tone.h"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr float kMinAlbedo = 0.001F;
constexpr float kMaxAlbedo = 0.98F;
constexpr float kBearded = 0.15F;        // share of beard from which a texture gets no make-up
constexpr float kPlainMottling = 0.05F;  // rms in log albedo of plain skin that asks for none
constexpr float kLipMelanin = 0.15F;     // how much less lips darken with the skin
constexpr float kLipRedness = 0.65F;     // least redness that lips keep on dark skin
constexpr float kShineLoss = 1.2F;       // of bright spots, per unit of log albedo that the skin gets lighter
constexpr float kFeatureFrom = 0.25F;  // deviation in log albedo from which it is a feature, not variation of skin ...
constexpr float kFeatureTo = 0.7F;     // ... and beyond which nothing is taken from it

// exp for |x| < 80, relative error below 3e-6: 2^whole through the exponent's bits, 2^rest by its series.
float fast_exp(float x) {
  const float power = x * 1.44269504F;
  const auto whole = static_cast<std::int32_t>(power + (power < 0 ? -0.5F : 0.5F));
  const float t = (power - static_cast<float>(whole)) * 0.69314718F;
  const float series = 1.0F + t * (1.0F + t * (0.5F + t * (1.0F / 6 + t * (1.0F / 24 + t * (1.0F / 120)))));
  return series * std::bit_cast<float>((whole + 127) << 23);
}

// 1 on the front of the face, where textures hold what a photo saw; 0 round it, where they hold what was filled in and, with luck, no
// edge of hair or collar.
float face_front(const Eigen::Vector3f& p) {
  const float x = p.x() / 0.068F;
  const float y = p.y() > 0 ? p.y() / 0.056F : 0.0F;
  const float x2 = x * x;
  const float y2 = y * y;
  return smooth_step(0.90F, 0.55F, x2 * x2 + y2 * y2) * smooth_step(-0.125F, -0.105F, p.y()) *
         smooth_step(-0.075F, -0.05F, p.z());
}

// The settings turned into what a point needs.
struct Recolour {
  Eigen::Matrix3f axes;  // columns: melanin, haemoglobin, remainder
  Eigen::Matrix3f coordinates;
  Eigen::Vector3f log_target;
  Eigen::Vector3f log_mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f shift = Eigen::Vector3f::Zero();  // from the texture's mean to the target
  float redness = 1;
  float lighter = 0;    // how much lighter, in log albedo, the target is than the texture
  float plain_lip = 0;  // redness of lips without texture
  float evenness = 0;
  float variation = 1;

  Recolour(const SkinTexture* texture, const SkinSettings& settings) {
    const PigmentAxes& pigments = pigment_axes();
    axes << pigments.melanin, pigments.haemoglobin, pigments.melanin.cross(pigments.haemoglobin).normalized();
    coordinates = axes.inverse();
    log_target = settings.target_tone.array().log();
    const float response = redness_response(settings.target_tone);
    plain_lip = 0.3F + 0.5F * response;
    evenness = settings.evenness;
    variation = settings.variation;
    if (texture == nullptr) return;
    log_mean = texture->mean_skin.array().log();
    shift = log_target - log_mean;
    redness = std::clamp(response / redness_response(texture->mean_skin), 0.35F, 1.25F);
    lighter = std::max(0.0F, shift.mean());
  }

  Eigen::Vector3f textured(const TextureSample& sample, const SkinPlace& place) const {
    const float lips = place.lips;
    Eigen::Vector3f deviation = sample.log_linear - log_mean - evenness * sample.log_broad;
    if (evenness > 0) deviation *= 1.0F - evenness * (1.0F - face_front(place.position));
    const float feature = std::max(lips, smooth_step(kFeatureFrom, kFeatureTo, deviation.norm()));
    const float kept = variation + (1.0F - variation) * feature;
    Eigen::Vector3f pigments = coordinates * deviation;
    const float lip_redness = redness + lips * (std::max(redness, kLipRedness) - redness);
    const float red = pigments[1];
    pigments[1] *= lip_redness;
    // What shines in a dark skin's texture, in part highlight left over, would be white on a light one.
    pigments /= 1.0F + kShineLoss * lighter * smooth_step(0.0F, 0.4F, deviation.mean());
    Eigen::Vector3f out = log_target + kept * (axes * pigments);
    if (lips > 0) out -= kLipMelanin * lips * smooth_step(0.0F, 0.2F, red) * shift;
    return out;
  }

  Eigen::Vector3f plain(float lips) const { return log_target + lips * plain_lip * axes.col(1); }
};

SkinPlace place_of(const SkinPoints& points, Eigen::Index i) {
  SkinPlace place;
  place.position = points.rest_position.row(i).transpose();
  place.region = points.region[static_cast<std::size_t>(i)];
  Eigen::RowVector4f soft;
  if (points.soft.rows() > 0) {
    soft = points.soft.row(i);
  } else {
    soft = soft_regions({place.region, place.region, place.region}, {1, 0, 0});
  }
  place.lips = soft[0];
  place.brows = soft[1];
  place.eyelids = soft[2];
  place.beard = soft[3];
  if (points.footprint_m.size() > 0) place.footprint_m = points.footprint_m[i];
  return place;
}

void check(const SkinSettings& settings, const SkinPoints& points) {
  const Eigen::Index count = points.rest_position.rows();
  const bool fits = static_cast<Eigen::Index>(points.region.size()) == count &&
                    (points.uv.rows() == count || points.uv.rows() == 0) &&
                    (points.footprint_m.size() == count || points.footprint_m.size() == 0) &&
                    (points.soft.rows() == count || points.soft.rows() == 0);
  if (!fits) throw std::invalid_argument("The arrays of skin points differ in length.");
  if (!(settings.target_tone.minCoeff() > 0.0F && settings.target_tone.maxCoeff() < 1.0F)) {
    throw std::invalid_argument("A skin's target tone must lie between 0 and 1 in every channel.");
  }
}

}  // namespace

Eigen::RowVector4f soft_regions(const std::array<Region, 3>& corners, const Eigen::Vector3f& weights) {
  Eigen::RowVector4f soft = Eigen::RowVector4f::Zero();
  for (int corner = 0; corner < 3; ++corner) {
    switch (corners[static_cast<std::size_t>(corner)]) {
      case Region::kLips: soft[0] += weights[corner]; break;
      case Region::kBrows: soft[1] += weights[corner]; break;
      case Region::kEyelids: soft[2] += weights[corner]; break;
      case Region::kUpperLip:
      case Region::kCheeks:
      case Region::kChin:
      case Region::kJaw: soft[3] += weights[corner]; break;
      default: break;
    }
  }
  return soft;
}

Eigen::MatrixX3f skin_albedo(const SkinTexture* texture, const SkinSettings& settings, const SkinPoints& points) {
  check(settings, points);
  SkinSettings plain_settings = settings;
  plain_settings.mottling = std::max(settings.mottling, kPlainMottling);
  SkinSettings textured_settings = settings;
  if (texture != nullptr && texture->beard > kBearded) {
    textured_settings.lip_tint = textured_settings.eye_shadow = textured_settings.blush = 0.0F;
  }
  const Marks marks(textured_settings);
  const Marks plain_marks(plain_settings);
  const Recolour recolour(texture, settings);
  Eigen::MatrixX3f albedo(points.rest_position.rows(), 3);
  for (Eigen::Index i = 0; i < albedo.rows(); ++i) {
    const SkinPlace place = place_of(points, i);
    Eigen::Vector3f log_albedo;
    bool textured = false;
    if (texture != nullptr && points.uv.rows() > 0) {
      const Eigen::Vector2f uv = points.uv.row(i).transpose();
      textured = uv.minCoeff() >= 0.0F && uv.maxCoeff() <= 1.0F;
      if (textured)
        log_albedo = recolour.textured(sample_texture(*texture, uv, place.footprint_m * texture->uv_per_m), place);
    }
    if (!textured) log_albedo = recolour.plain(place.lips);
    const Marks::Pigment added = (textured ? marks : plain_marks).pigment(place);
    log_albedo += added.melanin * recolour.axes.col(0) + added.haemoglobin * recolour.axes.col(1);
    Eigen::Vector3f value(fast_exp(log_albedo[0]), fast_exp(log_albedo[1]), fast_exp(log_albedo[2]));
    (textured ? marks : plain_marks).paint(place, textured, value);
    albedo.row(i) = value.cwiseMax(kMinAlbedo).cwiseMin(kMaxAlbedo).transpose();
  }
  return albedo;
}

}  // namespace faceprobe::synth
