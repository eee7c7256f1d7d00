#pragma once
// The MERL/ETH skin reflectance statistics (Weyrich et al. 2006, "Torrance-Sparrow statistics", file ts_data.mat), for those who have
// them: what core/skin_reflectance.h only estimates.
//
//   const ReflectanceStatistics measured = load_reflectance_statistics("ts_data.mat");
//   float m = measured.of(Region::kNose)->mean_roughness;

#include "faceprobe/core/region.h"
#include "faceprobe/synth/skin.h"

#include <array>
#include <filesystem>
#include <map>

namespace faceprobe::assets {

// Of the samples of one region. Values are the file's own: nothing is added to them.
struct RegionReflectance {
  int count = 0;                         // of samples; the rest is 0 without any, deviations with one
  double mean_roughness = 0;             // m, rms slope of the Beckmann distribution
  double roughness_deviation = 0;        // standard deviation
  double mean_specular_albedo = 0;       // rho_s
  double specular_albedo_deviation = 0;  // standard deviation
};
// By the file's region number, 1 .. 10, less 1.
using RegionTable = std::array<RegionReflectance, 10>;

struct ReflectanceStatistics {
  RegionTable all;
  std::map<int, RegionTable> by_skin_type;  // Fitzpatrick 1 .. 6, those that occur
  int skipped = 0;                          // samples with numbers that are not finite

  // All skin types; null for a region that the file has no samples of.
  const RegionReflectance* of(Region region) const;
};

// Throws Error(kInput): not a MATLAB file, a variable missing, sizes that do not go together, a region or subject that does not exist.
ReflectanceStatistics load_reflectance_statistics(const std::filesystem::path& path);

// As the generator of synthetic faces takes them (all skin types together).
synth::SkinStatistics skin_statistics(const ReflectanceStatistics& statistics);

}  // namespace faceprobe::assets
