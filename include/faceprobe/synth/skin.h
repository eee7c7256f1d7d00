#pragma once
// Skin: a measured texture moved over the human range by melanin and haemoglobin, with lips, brows, stubble, freckles, moles and
// make-up on top; reflectance per region; pores as a disturbance of the normal. Evaluated per fragment, so a new skin on a head that
// has been lit costs next to nothing.
//
//   SkinSettings skin = draw_skin(textures.size(), random);
//   Eigen::MatrixX3f albedo = skin_albedo(textures[skin.texture], skin, points);

#include "faceprobe/core/image.h"
#include "faceprobe/core/random.h"
#include "faceprobe/core/region.h"

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace faceprobe::synth {

// An albedo texture in some head's UVs; row 0 is v = 1. Its level is a photo's exposure, so `mean_skin` says what it is.
struct SkinTexture {
  std::string name;
  ByteImage srgb;                  // three channels
  Eigen::Vector3f mean_skin;       // linear, mean over cheeks and forehead: what the tone is measured from
  std::vector<ByteImage> smaller;  // sRGB, each half as wide and high as the one before (averages of linear light)
  Image broad;            // broad deviation of log(linear) from log(mean_skin): shading left over, redness, tan
  float beard = 0;        // share of moustache and chin that is dark hair, where kIctFace has them; no make-up there
  float uv_per_m = 3.4F;  // how much of the square a metre of skin takes up, for choosing among `smaller`
};
// Throws Error(kInput): not three channels, empty, black.
SkinTexture prepare_texture(const std::string& name, ByteImage srgb);

struct SkinSettings {
  int texture = -1;             // of the list; -1 = plain skin without texture
  Eigen::Vector3f target_tone;  // linear mean skin albedo wanted
  float variation = 1.0F;       // of the texture's own melanin and haemoglobin contrast
  float evenness = 0.0F;        // share taken out of the texture's broad deviations, and of all round the face; 0 .. 1
  float mottling = 0.0F;        // patches a few millimetres wide, of melanin and haemoglobin: rms in log albedo
  float redness = 0.0F;         // haemoglobin in cheeks, nose, ears
  float lip_tint = 0.0F;        // strength of the lipstick, 0 .. 1
  Eigen::Vector3f lip_colour{0.4F, 0.05F, 0.08F};       // lipstick, 0 .. 1
  float eye_shadow = 0.0F;                              // 0 .. 1
  Eigen::Vector3f eye_colour{0.1F, 0.08F, 0.1F};        // of the eye shadow, albedo, linear
  float blush = 0.0F;                                   // 0 .. 1
  float freckles = 0.0F;                                // 0 .. 1
  float moles = 0.0F;                                   // 0 .. 1
  float stubble = 0.0F;                                 // 0 .. 1
  float brow = 0.0F;                                    // brows darkened, 0 .. 1
  Eigen::Vector3f hair_colour{0.03F, 0.02F, 0.015F};    // of brows and stubble, albedo, linear
  std::array<float, kSkinRegionCount> roughness;        // m per region, jittered around core/skin_reflectance.h
  std::array<float, kSkinRegionCount> specular_albedo;  // rho_s per region
  float pore_slope = 0.05F;                             // rms slope of the pores' normals, both axes together
  float pore_size_m = 0.0012F;
  std::uint64_t seed = 0;  // of freckles, moles, pores
};
// Measured reflectance per region: mean and standard deviation over people. Skin regions without measurements keep the estimate.
struct SkinStatistics {
  struct Value {
    float roughness = 0, roughness_deviation = 0;              // m
    float specular_albedo = 0, specular_albedo_deviation = 0;  // rho_s
    bool measured = false;
  };
  std::array<Value, kSkinRegionCount> regions;
};
// `statistics` replaces the estimate of core/skin_reflectance.h and its jitter; may be null.
SkinSettings draw_skin(int texture_count, Random& random, const SkinStatistics* statistics = nullptr);
// The paper's Section 5.1: one specular albedo, uniform in [0, 1], for the whole face; no make-up, no pores.
SkinSettings draw_paper_skin(int texture_count, Random& random);

// Where albedo is asked for. Arrays of the same length.
struct SkinPoints {
  Eigen::MatrixX2f uv;             // v up
  Eigen::MatrixX3f rest_position;  // head frame, metres: where the point is on the undeformed person; for noise in 3D
  std::vector<Region> region;
  Eigen::VectorXf footprint_m;  // size of a pixel on the skin; what is finer is averaged. Empty = as fine as the texture
  Eigen::MatrixX4f soft;        // rows of soft_regions(), so that make-up has no steps; empty = from `region`
};
// Share of lips, brows, eyelids and beard area (upper lip, chin, jaw) at a point of a triangle, from its corners.
Eigen::RowVector4f soft_regions(const std::array<Region, 3>& corners, const Eigen::Vector3f& weights);

// #points x 3, linear. `texture` may be null: plain tone. Throws std::invalid_argument for arrays of different lengths and for a target tone
// outside (0, 1).
Eigen::MatrixX3f skin_albedo(const SkinTexture* texture, const SkinSettings& settings, const SkinPoints& points);

// Normals (#points x 3, unit length) disturbed by pores; footprint_m: size of a pixel on the skin, below which pores average out
// into roughness instead (returned variance, per slope axis, is to be added to m^2 / 2).
struct PoreNormals {
  Eigen::MatrixX3f normal;               // #points x 3, unit
  Eigen::VectorXf added_slope_variance;  // #points
};
// `rest_position`: #points x 3, head frame, metres. Throws std::invalid_argument for arrays of different lengths.
PoreNormals pore_normals(const SkinSettings& settings, const Eigen::MatrixX3f& rest_position,
                         const Eigen::MatrixX3f& normal, const Eigen::VectorXf& footprint_m);

// Linear Rec.709 albedo of skin. melanin: share of the epidermis' volume that is melanosomes, about .01 (very light) to .43 (darkest);
// haemoglobin: share of the dermis' volume that is blood, about .002 to .07. Falls with both. See the source for the model.
Eigen::Vector3f skin_tone(float melanin, float haemoglobin);

}  // namespace faceprobe::synth
