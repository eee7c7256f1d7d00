#include "faceprobe/core/skin_reflectance.h"
#include "faceprobe/synth/skin.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr double kLightest = 0.013;  // melanin
constexpr double kDarkest = 0.42;
constexpr float kPaperRoughness = 0.3F;
constexpr float kPaperTone = 0.9F;

float between(Random& random, double low, double high) { return static_cast<float>(random.between(low, high)); }

// Lightness goes about evenly with the logarithm of melanin; so do the tones that are drawn, whatever the textures at hand.
Eigen::Vector3f draw_tone(Random& random, float& melanin) {
  melanin = static_cast<float>(random.log_between(kLightest, kDarkest));
  Eigen::Vector3f tone = skin_tone(melanin, static_cast<float>(random.log_between(0.018, 0.06)));
  // What two pigments do not explain: carotene, bilirubin, the depth of vessels.
  for (int c = 0; c < 3; ++c) tone[c] *= static_cast<float>(std::exp(random.normal(0.0, 0.022)));
  return tone.cwiseMin(0.9F);
}

Eigen::Vector3f draw_hair(Random& random, float melanin) {
  static const std::array<Eigen::Vector3f, 6> kColours = {
      Eigen::Vector3f(0.018F, 0.014F, 0.012F), Eigen::Vector3f(0.040F, 0.025F, 0.017F),
      Eigen::Vector3f(0.085F, 0.050F, 0.030F), Eigen::Vector3f(0.200F, 0.130F, 0.070F),
      Eigen::Vector3f(0.150F, 0.055F, 0.022F), Eigen::Vector3f(0.180F, 0.170F, 0.160F)};
  const int light = random.below(6);
  const int dark = random.below(8);
  const bool fair = melanin < 0.05F;
  const Eigen::Vector3f& colour = kColours[static_cast<std::size_t>(fair ? light : std::min(dark / 5, 1))];
  return colour * between(random, 0.75, 1.3);
}

void draw_make_up(Random& random, SkinSettings& skin) {
  const Eigen::Vector3f natural = skin.target_tone.cwiseProduct(Eigen::Vector3f(0.85F, 0.42F, 0.48F));
  const Eigen::Vector3f red(between(random, 0.18, 0.42), between(random, 0.015, 0.06), between(random, 0.02, 0.10));
  const Eigen::Vector3f dark(between(random, 0.08, 0.2), between(random, 0.01, 0.04), between(random, 0.02, 0.06));
  const double kind = random.uniform();
  skin.lip_colour = kind < 0.5 ? natural : kind < 0.85 ? red : dark;
  skin.lip_tint = between(random, 0.25, 0.95);
  static const std::array<Eigen::Vector3f, 5> kShadows = {
      Eigen::Vector3f(0.10F, 0.06F, 0.045F), Eigen::Vector3f(0.06F, 0.06F, 0.07F), Eigen::Vector3f(0.16F, 0.08F, 0.10F),
      Eigen::Vector3f(0.08F, 0.09F, 0.14F), Eigen::Vector3f(0.20F, 0.13F, 0.07F)};
  skin.eye_colour = kShadows[static_cast<std::size_t>(random.below(5))];
  const float shadow = between(random, 0.15, 0.8);
  const float blush = between(random, 0.2, 0.8);
  skin.eye_shadow = random.chance(0.6) ? shadow : 0.0F;
  skin.blush = random.chance(0.6) ? blush : 0.0F;
}

void draw_reflectance(Random& random, SkinSettings& skin) {
  const double rough = std::exp(random.normal(0.0, 0.13));
  const double shiny = random.log_between(0.6, 1.6);
  for (int r = 0; r < kSkinRegionCount; ++r) {
    const SkinReflectance usual = skin_reflectance(static_cast<Region>(r + 1));
    const auto i = static_cast<std::size_t>(r);
    const double roughness = static_cast<double>(usual.roughness) * rough * std::exp(random.normal(0.0, 0.06));
    const double albedo = static_cast<double>(usual.specular_albedo) * shiny * std::exp(random.normal(0.0, 0.12));
    skin.roughness[i] = static_cast<float>(std::clamp(roughness, 0.16, 0.5));
    skin.specular_albedo[i] = static_cast<float>(std::clamp(albedo, 0.03, 0.6));
  }
}

// One person is shiny or dull all over: half of the measured variance is taken to be the person's, half the region's own.
void draw_measured_reflectance(const SkinStatistics& statistics, Random& random, SkinSettings& skin) {
  constexpr double kShared = 0.7071;
  const double rough = random.normal();
  const double shiny = random.normal();
  for (std::size_t i = 0; i < statistics.regions.size(); ++i) {
    const double own_rough = random.normal();
    const double own_shiny = random.normal();
    const SkinStatistics::Value& value = statistics.regions[i];
    if (!value.measured) continue;
    skin.roughness[i] = std::clamp(
        value.roughness + value.roughness_deviation * static_cast<float>(kShared * (rough + own_rough)), 0.1F, 0.7F);
    skin.specular_albedo[i] = std::clamp(
        value.specular_albedo + value.specular_albedo_deviation * static_cast<float>(kShared * (shiny + own_shiny)),
        0.01F, 1.0F);
  }
}

std::uint64_t draw_seed(Random& random) {
  const std::uint64_t high = random.bits();
  return (high << 32U) | random.bits();
}

int draw_texture(int texture_count, Random& random) { return texture_count > 0 ? random.below(texture_count) : -1; }

}  // namespace

SkinSettings draw_skin(int texture_count, Random& random, const SkinStatistics* statistics) {
  SkinSettings skin;
  skin.texture = draw_texture(texture_count, random);
  float melanin = 0;
  skin.target_tone = draw_tone(random, melanin);
  skin.variation = between(random, 0.55, 1.0);
  skin.evenness = between(random, 0.6, 0.95);
  skin.mottling = between(random, 0.01, 0.045);
  const float redness = static_cast<float>(std::abs(random.normal(0.0, 0.45)));
  skin.redness = std::min(redness, 1.2F);
  skin.hair_colour = draw_hair(random, melanin);
  const bool made_up = random.chance(0.25);
  const bool bearded = random.chance(1.0 / 3.0);  // of the rest: a quarter of all
  if (made_up) draw_make_up(random, skin);
  const float stubble = between(random, 0.15, 1.0);
  if (bearded && !made_up) skin.stubble = stubble;
  const float freckles = between(random, 0.15, 1.0);
  if (random.chance(melanin < 0.04F ? 0.35 : melanin < 0.12F ? 0.1 : 0.02)) skin.freckles = freckles;
  const float moles = between(random, 0.1, 0.8);
  if (random.chance(0.5)) skin.moles = moles;
  const float brow = between(random, 0.15, 0.8);
  if (random.chance(0.35)) skin.brow = brow;
  if (skin.texture < 0) skin.brow = between(random, 0.6, 1.0);  // there are none in plain skin
  draw_reflectance(random, skin);
  if (statistics != nullptr) draw_measured_reflectance(*statistics, random, skin);
  skin.pore_slope = between(random, 0.02, 0.12);
  skin.pore_size_m = between(random, 0.0007, 0.0018);
  skin.seed = draw_seed(random);
  return skin;
}

SkinSettings draw_paper_skin(int texture_count, Random& random) {
  SkinSettings skin;
  skin.texture = draw_texture(texture_count, random);
  float melanin = 0;
  skin.target_tone = draw_tone(random, melanin).cwiseMin(kPaperTone);
  skin.roughness.fill(kPaperRoughness);
  skin.specular_albedo.fill(between(random, 0.0, 1.0));
  skin.evenness = 0.8F;
  skin.brow = skin.texture < 0 ? 0.8F : 0.0F;
  skin.pore_slope = 0.0F;
  skin.seed = draw_seed(random);
  return skin;
}

}  // namespace faceprobe::synth
