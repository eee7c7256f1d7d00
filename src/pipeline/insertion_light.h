#pragma once
// The light that a thing in a photo stands in.

#include "faceprobe/pipeline/insertion.h"

#include <Eigen/Core>

namespace faceprobe::pipeline {

// Sets the scene's environment and lamps for a thing whose foot is there (camera frame, metres): the map of the face that is nearest, or that the
// options name, or the joint one; and of its main lights those that several faces see at one place as lamps there, and out of the map.
void light_scene(const Estimate& estimate, const Eigen::Vector3f& foot, const InsertionOptions& options,
                 insert::Scene& scene);

}  // namespace faceprobe::pipeline
