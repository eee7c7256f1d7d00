#pragma once
// One training example: a photo as a camera would write it, and every layer it was made of. All pictures have the photo's size; the
// linear ones share the scale 1 = the photo's white.
//
//   const Sample sample = reader.copy_sample(7);                      // synth/shard.h
//   const float mirrored = sample.highlight(x, y, 0);                 // red, linear

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/synth/light_sample.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

namespace faceprobe::synth {

// One person in a picture.
struct FaceMarks {
  Eigen::MatrixX2f landmarks_px;                                       // 68 x 2 or empty
  Eigen::MatrixX2f dense_landmarks_px;                                 // 468 x 2 or empty
  Eigen::Isometry3f camera_from_head = Eigen::Isometry3f::Identity();  // metres
  Eigen::VectorXf identity;                                            // head parameters
  Eigen::VectorXf expression;                                          // the same, see HeadParameters
  int person = 0;                                                      // samples of one person share it
};

// What does not change from one light to the next.
struct ViewLayers {
  Image normal;      // 3 channels, camera frame, unit length; zero on the background
  Image depth_m;     // 1 channel, along the camera's -z; zero on the background
  ByteImage region;  // 1 channel, Region
  ByteImage owner;   // 1 channel: number in `faces` of the person seen there, plus 1; zero on the background
  float focal_px = 0;
  Eigen::Vector2f centre_px{0, 0};  // principal point, from the top left corner
  std::vector<FaceMarks> faces;     // one, or those of a group from left to right
};

struct Sample {
  ByteImage photo;     // 3 channels, sRGB-encoded
  ByteImage clip;      // 1 channel, bits as SensorPicture::clip
  Image highlight;     // 3 channels each, linear: light mirrored at the surface
  Image diffuse;       // the rest of the picture's light; diffuse + highlight = the linear photo before the camera
  Image albedo;        // diffuse reflectance; zero on the background
  Image shading;       // diffuse = albedo * shading on the person; zero on the background
  EnvMap environment;  // distant light, camera frame, same scale
  std::vector<NearLight> lamps;  // of a group's room: camera frame, radiance on the same scale
  int map = 0;                   // number of the map ...
  float map_yaw = 0;             // ... and its turn about +y, radians
  std::string settings_json;     // skin, camera and wardrobe as drawn, one JSON object
};

}  // namespace faceprobe::synth
