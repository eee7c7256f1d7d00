#pragma once
// Internal: which map lights a sample, how it is turned, and how the camera exposes it.

#include "faceprobe/synth/assets.h"
#include "faceprobe/synth/person.h"
#include "faceprobe/synth/sensor.h"

namespace faceprobe::synth {

struct SampleDraw {
  int map = 0;
  float map_yaw = 0;
  float map_level = 0;  // mean irradiance of the map in a room with lamps; 0 = the map as it is
  int skin = 0;
  float white_balance = 0;        // share of the light's colour that the camera takes out
  Eigen::Vector3f cast{1, 1, 1};  // what its white balance gets wrong
  float exposure = 1;             // factor on the usual brightness of the face
  float background_blur_px = 0;
  SensorSettings sensor;
};

SampleDraw draw_sample(const Assets& assets, const Recipe& recipe, Random& random, int index);
// The part of it that is the camera's: white balance, exposure, blur of the background, sensor.
void draw_camera(Random& random, int size_px, SampleDraw& draw);

// Gain per channel that exposes a face of mean radiance `face` (skin of tone `tone`) under light of colour `light`.
Eigen::Vector3f exposure_gain(const SampleDraw& draw, const Eigen::Vector3f& face, const Eigen::Vector3f& light,
                              const Eigen::Vector3f& tone);

}  // namespace faceprobe::synth
