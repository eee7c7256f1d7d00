#pragma once
// Where things are on a head: what clothes, hair and glasses are fitted to. Head frame, metres.

#include "faceprobe/synth/head_model.h"

namespace faceprobe::synth {

struct Anatomy {
  SurfaceMesh skin;              // all skin meshes in one
  Eigen::MatrixX3f landmarks;    // 68 x 3, Multi-PIE order; guessed from the bounding box where the head has none
  float scale = 1.0F;            // size against an average adult's
  Eigen::Vector3f skull_centre;  // middle of the skull above the brows
  Eigen::Vector3f skull_radii;   // half extents
  Eigen::Vector3f neck_centre;   // middle of the neck, a little below the chin
  float neck_radius = 0.055F;
  float ear_top = 0.005F;      // y
  float ear_bottom = -0.055F;  // y
  float ear_front = -0.06F;    // z of the tragus
  float ear_back = -0.11F;     // z

  Eigen::Vector3f landmark(int i) const { return landmarks.row(i).transpose(); }
  Eigen::Vector3f landmark_mean(int first, int count) const {
    return landmarks.middleRows(first, count).colwise().mean().transpose();
  }
  float brow_y() const { return landmarks.middleRows(17, 10).col(1).mean(); }
};

// Throws std::invalid_argument when the head has no skin.
Anatomy measure(const Head& head);

}  // namespace faceprobe::synth
