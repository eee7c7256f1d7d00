#pragma once
// One skin in several photos. Each photo's diffuse layer is that skin's albedo times the light that fell on it, and each photo was split for itself:
// what its albedo is off in colour, its light is off the other way. The albedo is the person's, so the splits have to agree on it. Here they vote:
//
//   log A = robust mean over photos of log A_i,   light_i * A_i / A
//
// in log luminance, log(r/g) and log(b/g), weighted by what each states of its error. Where the errors are independent, a photo's light keeps their
// mean, 1 / sqrt(#photos) of them. Ratios of lights between photos are then those of the diffuse layers, and owe nothing to any albedo.
//
//   const SharedSkin skin = share_skin({reading_of_photo_1, reading_of_photo_2});
//   shading_1 *= skin.photos[0].gain;                        // and albedo_1 /= it
//
// Not for photos of different people, nor for one with and without make-up or a tan. What all splits have wrong alike stays wrong.

#include "faceprobe/core/region.h"

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace faceprobe::lighting {

// The skin as one photo has it. Albedos are linear and above 0.
struct SkinReading {
  Eigen::Vector3f albedo = Eigen::Vector3f::Ones();                            // mean of the face
  std::array<std::optional<Eigen::Vector3f>, kSkinRegionCount> region_albedo;  // where enough of the region is seen
  // One standard deviation of log(r/g) and log(b/g) of `albedo`; unset = not stated, taken for kUnstatedDeviation.
  std::optional<double> log_deviation;
  // Whether that error and the albedo come of skin_colour_prior() (lighting/albedo.h) and this photo: the prior then counts once, not once a photo.
  bool has_prior = false;
  bool grey = false;  // the photo has no colour: it has a say in the luminance alone, and its light stays grey
};

// ESTIMATE: what the network's shading is off in colour, 3 to 6 degrees (docs/measurements.md), is a tenth in log chromaticity.
inline constexpr double kUnstatedDeviation = 0.1;

struct SharedSkin {
  struct Photo {
    Eigen::Vector3f gain;  // what the light of the photo is to be multiplied by: own albedo over shared
    std::array<Eigen::Vector3f, kSkinRegionCount> region_gain;  // the same of each region; `gain` where it was not seen
    double trust =
        1;  // weight of this photo's colour (if grey, luminance): 1 where it agrees with the others, towards 0 for an outlier
  };
  Eigen::Vector3f albedo;  // the person's, linear
  double log_deviation =
      0;  // one standard deviation of log(r/g) and log(b/g) of it; more than stated where photos disagree by more
  std::vector<Photo> photos;  // in the order of the readings
};

// Of one reading: that reading, with gains of 1. Throws std::invalid_argument for none, and for albedos or deviations that are not above 0 and finite.
SharedSkin share_skin(const std::vector<SkinReading>& readings);

// Mean of the logarithms of gains (above 0), robust against single ones that are off; 1 for none. What photos of one person say of how its highlights
// compare with its shading (Light::highlight_gain).
double shared_gain(const std::vector<double>& gains);

}  // namespace faceprobe::lighting
