#pragma once
// An environment map as a camera that stands in it would photograph it, and the light that camera stands in: what a network that
// looks at a scene's background is trained and measured on.
//
//   const MapCropOptions view{.yaw_rad = 1.2F};
//   const Image crop = crop_of_map(map, view);
//   const EnvMap light = map_of_crop(map, view);

#include "faceprobe/core/env_map.h"

namespace faceprobe::train {

// A light at d in the map is at turn_x(pitch) turn_y(yaw) d in the crop's camera frame, each turn right-handed: by a positive yaw what is
// ahead moves to the left, by a positive pitch up.
struct MapCropOptions {
  int px = 96;
  float field_of_view_rad = 1.05F;  // of the crop's width
  float yaw_rad = 0;
  float pitch_rad = 0;
  float exposure = 1;  // after the crop's mean, as clipped, is brought to .35
};

// px x px x 3, linear, clipped to 0 .. 1 as a camera would, quantised to 8 bits of sRGB. The camera looks along -z of the camera frame
// after turning the map by yaw about +y and pitch about +x. Throws std::invalid_argument: no map, px < 1, a field of view outside 0 .. pi,
// an exposure that is not above 0.
Image crop_of_map(const EnvMap& map, const MapCropOptions& options);

// The same map turned as the crop's camera sees it, so that it is the crop's true light, on the crop's scale, where 1 is its white. Throws as
// crop_of_map.
EnvMap map_of_crop(const EnvMap& map, const MapCropOptions& options);

}  // namespace faceprobe::train
