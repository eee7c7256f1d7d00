#pragma once
// A first albedo: one skin colour per region, smooth by construction, from the diffuse layer and two priors. It exists so that
// shading can be had before a network tells albedo from shading pixel by pixel; freckles, stubble and make-up stay in the shading.
//
// The product light colour x skin colour is all a photo shows. In log chromaticity both factors get a normal prior - photos are
// roughly white-balanced, skins lie on a short locus - and the posterior mean splits the product (ESTIMATES: see albedo.cpp). How light the
// regions are beside one another is found along with a smooth light where normals are given, and is the usual where they are not.
//
//   const AlbedoModel model = fit_albedo(layers.diffuse, skin_region, clipped, geometry.normal_cam);
//   const Image albedo = albedo_picture(model, skin_region);           // shading = diffuse / albedo

#include "faceprobe/core/image.h"
#include "faceprobe/core/region.h"

#include <Eigen/Core>
#include <array>
#include <optional>

namespace faceprobe::lighting {

struct AlbedoModel {
  std::array<Eigen::Vector3f, kSkinRegionCount> region_albedo;  // linear; the cheeks' luminance is kSkinLuminance
  Eigen::Vector3f light_colour;                                 // mean light, linear, green = 1
  // One standard deviation of the posterior of light_colour: root mean square of the angle between it and the true light's colour, as vectors of
  // linear red, green and blue. What the two priors leave open; errors of the diffuse layer come on top. Unset for a grey photo.
  std::optional<double> light_colour_uncertainty_deg;
};

inline constexpr float kSkinLuminance = 0.35F;  // assumed mean diffuse albedo; a photo does not tell its exposure

// What skins are like before the photo is asked: mean of log(r/g) and log(b/g) of their albedo, and the standard deviation of both.
struct SkinColourPrior {
  Eigen::Array2d log_ratio;  // 2 values: mean of log(r/g), log(b/g)
  double deviation;          // above 0, of either
};
// The one that fit_albedo() goes by.
SkinColourPrior skin_colour_prior();

// Root mean square angle in degrees between a linear colour and colours whose log(r/g) and log(b/g) are off by independent normal errors of that
// standard deviation, to first order; and the deviation of such an angle.
double colour_uncertainty_deg(const Eigen::Vector3f& colour, double log_deviation);
double colour_log_deviation(const Eigen::Vector3f& colour, double uncertainty_deg);

// `diffuse`: H x W x 3 linear. `skin_region`: H x W x 1, Region where skin, 0 elsewhere. `clipped`: H x W x 1, non-zero
// pixels are left out. `normal_cam`: H x W x 3, unit, camera frame, or an empty picture where normals are not known. A face without any usable
// skin pixel gets the prior's mean. `grey`: the photo has no colour, so skin and light
// are taken as grey. Throws std::invalid_argument when sizes or channels differ.
AlbedoModel fit_albedo(const Image& diffuse, const ByteImage& skin_region, const ByteImage& clipped,
                       const Image& normal_cam = {}, bool grey = false);
// H x W x 3: the region's albedo at each skin pixel, blurred across borders; the cheeks' elsewhere.
Image albedo_picture(const AlbedoModel& model, const ByteImage& skin_region);

}  // namespace faceprobe::lighting
