#include "synth/skin/marks.h"

#include "faceprobe/core/color.h"
#include "synth/skin/noise.h"
#include "synth/skin/tone.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

enum Purpose : std::uint32_t { kMottle = 1, kFreckle, kMole, kHair };

constexpr float kMottleM = 0.009F;  // width of the patches
constexpr float kFreckleCellM = 0.0042F;
constexpr float kMoleCellM = 0.022F;
constexpr float kHairM = 0.0006F;       // distance of stubble's hairs
constexpr float kLightMelanin = 0.02F;  // what freckles and redness are told from best

constexpr float kLightLuminance =
    0.35F;  // of skin on which make-up shows its own colour; it is thin, and on darker skin darker

// A bell over the front of the face, mirrored; about (x, y), 1 in the middle.
float bell(const Eigen::Vector3f& p, float x, float y, float width, float height) {
  const float dx = (std::abs(p.x()) - x) / width;
  const float dy = (p.y() - y) / height;
  const float q = dx * dx + dy * dy;
  if (q > 9.0F) return 0.0F;
  return std::exp(-0.5F * q) * smooth_step(-0.09F, -0.05F, p.z());
}

// Round spots, at most one per cell and wholly inside it, so that one look at the own cell is enough. A surface cuts the balls at any
// height: their discs have all sizes. Returns 0 .. 1. `share` of the cells have one.
float spots(const Eigen::Vector3f& position, std::uint32_t key, float cell_m, float share, float min_radius_m,
            float max_radius_m, float footprint_m) {
  const Eigen::Vector3f q = position / cell_m;
  const Eigen::Vector3f corner = q.array().floor();
  const Cell cell{static_cast<std::int32_t>(corner.x()), static_cast<std::int32_t>(corner.y()),
                  static_cast<std::int32_t>(corner.z())};
  const float chance = unit_float(cell_bits(cell, key));
  if (chance >= share) return 0.0F;
  const float present =
      std::min(1.0F, (share - chance) / (0.15F * share));  // so that a changing share cuts no spot in half
  const float size = unit_float(cell_bits(cell, key + 1));
  const float radius = (min_radius_m + (max_radius_m - min_radius_m) * size * size) / cell_m;
  Eigen::Vector3f centre;
  for (int axis = 0; axis < 3; ++axis) {
    centre[axis] =
        radius + (1.0F - 2.0F * radius) * unit_float(cell_bits(cell, key + 2 + static_cast<std::uint32_t>(axis)));
  }
  // A pixel wider than the spot sees it larger and fainter.
  const float half_pixel = 0.5F * footprint_m / cell_m;
  const float wide = std::min(0.5F, std::sqrt(radius * radius + half_pixel * half_pixel));
  const float amplitude = (radius * radius) / (wide * wide);
  const float r = (q - corner - centre).norm() / wide;
  return present * amplitude * (0.5F + 0.5F * unit_float(cell_bits(cell, key + 5))) * smooth_step(1.0F, 0.45F, r);
}

// What of noise this wide is left in pixels this large.
float band_limit(float width_m, float footprint_m) {
  const float ratio = footprint_m / width_m;
  return 1.0F / (1.0F + ratio * ratio * ratio * ratio);
}

// Brows of plain skin: hairs that lie along the brow.
float brow_hairs(const SkinPlace& place, std::uint32_t key) {
  const Eigen::Vector3f along(place.position.x() / 0.0035F, place.position.y() / 0.0009F, place.position.z() / 0.0035F);
  return std::clamp(0.78F + 0.18F * band_limit(0.0009F, place.footprint_m) * value_noise(along, key), 0.0F, 1.0F);
}

void mix(Eigen::Vector3f& albedo, const Eigen::Vector3f& colour, float share) { albedo += share * (colour - albedo); }

}  // namespace

Marks::Marks(const SkinSettings& settings)
    : settings_(settings), tone_luminance_(std::max(1e-3F, luminance(settings.target_tone.data()))),
      redness_response_(redness_response(settings.target_tone) /
                        redness_response(skin_tone(kLightMelanin, kTypicalBlood))),
      freckle_strength_(1.1F * settings.freckles / (1.0F + 0.15F * melanin_of(settings.target_tone) / kLightMelanin)),
      make_up_cover_(std::min(1.0F, 0.25F + 0.75F * std::sqrt(tone_luminance_ / kLightLuminance))),
      mottle_key_(noise_key(settings.seed, kMottle)), freckle_key_(noise_key(settings.seed, kFreckle)),
      mole_key_(noise_key(settings.seed, kMole)), hair_key_(noise_key(settings.seed, kHair)) {}

Marks::Pigment Marks::pigment(const SkinPlace& place) const {
  const Eigen::Vector3f& p = place.position;
  Pigment out;
  if (settings_.mottling > 0) {
    // Two scales each; the second lattice is turned against the first so that neither shows.
    const Eigen::Vector3f a = p / kMottleM;
    const Eigen::Vector3f b(1.3F * (a.x() + a.y()), 1.3F * (a.y() - a.x()), 1.83F * a.z() + 7.3F);
    const float coarse = value_noise(a, mottle_key_);
    const float fine = value_noise(b, mottle_key_ + 1);
    out.melanin += settings_.mottling * 0.7071F * coarse;
    out.haemoglobin += settings_.mottling * 0.7071F * redness_response_ * fine;
  }
  if (settings_.redness > 0) {
    const float ears = smooth_step(0.066F, 0.075F, std::abs(p.x())) * smooth_step(-0.075F, -0.055F, p.y()) *
                       smooth_step(0.035F, 0.015F, p.y());
    const float where =
        std::max({bell(p, 0.038F, -0.036F, 0.016F, 0.014F), 0.9F * bell(p, 0.0F, -0.040F, 0.013F, 0.012F), 0.6F * ears,
                  0.35F * bell(p, 0.0F, -0.100F, 0.018F, 0.010F)});
    out.haemoglobin += 0.5F * settings_.redness * redness_response_ * where;
  }
  if (settings_.freckles > 0) {
    const float where = 0.12F + 0.88F * std::max(bell(p, 0.022F, -0.026F, 0.026F, 0.017F),
                                                 0.4F * bell(p, 0.0F, 0.050F, 0.045F, 0.022F));
    const float share = 0.75F * settings_.freckles * where;
    const float small = spots(p, freckle_key_, kFreckleCellM, share, 0.0005F, 0.0017F, place.footprint_m);
    const Eigen::Vector3f turned(0.8F * p.x() + 0.6F * p.y(), 0.8F * p.y() - 0.6F * p.x(), p.z() + 0.0021F);
    const float more =
        spots(turned, freckle_key_ + 16, 0.7F * kFreckleCellM, share, 0.0003F, 0.0011F, place.footprint_m);
    out.melanin += freckle_strength_ * std::max(small, more);
  }
  if (settings_.moles > 0) {
    out.melanin += 2.2F * spots(p, mole_key_, kMoleCellM, 0.5F * settings_.moles, 0.0006F, 0.0022F, place.footprint_m);
  }
  return out;
}

float Marks::beard_coverage(const SkinPlace& place) const {
  const Eigen::Vector3f& p = place.position;
  const float side = std::max(0.0F, std::abs(p.x()) - 0.03F);
  const float line = -0.056F + 0.5F * side;  // beard's upper edge on the cheek, from beside the mouth up to the ear
  float where = place.beard * smooth_step(line + 0.007F, line - 0.011F, p.y());
  if (place.region == Region::kOther) {
    where = std::max(where, 0.45F * smooth_step(-0.085F, -0.10F, p.y()) * smooth_step(-0.14F, -0.11F, p.y()) *
                                smooth_step(-0.08F, -0.05F, p.z()));
  }
  if (where <= 0) return 0.0F;
  const float hairs = band_limit(kHairM, place.footprint_m);
  const float grain = hairs > 0.02F ? hairs * value_noise(p / kHairM, hair_key_) : 0.0F;
  const float patches = 0.08F * value_noise(p / 0.006F, hair_key_ + 1);
  return std::clamp(0.42F * settings_.stubble * where * (1.0F + 0.6F * grain + patches), 0.0F, 0.9F);
}

void Marks::paint(const SkinPlace& place, bool textured, Eigen::Vector3f& albedo) const {
  const Eigen::Vector3f& p = place.position;
  const float relative = luminance(albedo.data()) / tone_luminance_;  // lighter or darker than the skin's mean
  if (settings_.blush > 0) {
    const float where = bell(p, 0.044F, -0.032F, 0.016F, 0.011F) * (1.0F - place.lips);
    const Eigen::Vector3f blushed = albedo.cwiseProduct(Eigen::Vector3f(0.98F, 0.55F, 0.62F));
    mix(albedo, blushed, 0.6F * settings_.blush * where);
  }
  if (settings_.stubble > 0) {
    const float coverage = beard_coverage(place) * (1.0F - place.lips);
    // Seen through skin in part, hence lighter and greyer than the hair itself.
    if (coverage > 0) {
      const Eigen::Vector3f shown = settings_.hair_colour + Eigen::Vector3f::Constant(0.06F * luminance(albedo.data()));
      mix(albedo, shown, coverage);
    }
  }
  if (settings_.brow > 0 && place.brows > 0) {
    const float hairs = textured ? smooth_step(0.8F, 0.45F, relative) : brow_hairs(place, hair_key_ + 2);
    mix(albedo, settings_.hair_colour, 0.85F * settings_.brow * place.brows * hairs);
  }
  if (settings_.eye_shadow > 0) {
    const float lid = place.eyelids * smooth_step(-0.005F, 0.003F, p.y());
    const float halo = 0.7F * bell(p, 0.032F, 0.009F, 0.013F, 0.006F) * (1.0F - place.brows);
    mix(albedo, settings_.eye_colour * (make_up_cover_ * (0.6F + 0.4F * relative)),
        0.75F * settings_.eye_shadow * std::max(lid, halo));
  }
  if (settings_.lip_tint > 0 && place.lips > 0) {
    mix(albedo, settings_.lip_colour * (make_up_cover_ * (0.5F + 0.6F * std::min(1.0F, relative))),
        0.85F * settings_.lip_tint * place.lips);
  }
}

}  // namespace faceprobe::synth
