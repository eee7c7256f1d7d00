#pragma once
// Where on a head model the 468 points of the dense face mesh lie, found the way they are found in photos: by showing the finder a
// picture of the model. A loader's work, done once per model.
//
//   model.dense_landmarks = pipeline::locate_dense_landmarks(model, finder);

#include "faceprobe/face/face.h"
#include "faceprobe/synth/head_model.h"

#include <vector>

namespace faceprobe::pipeline {

struct DenseLandmarkOptions {
  ByteImage texture;  // sRGB skin in the model's UVs; empty = the model's own, else plain skin with brows and lips by region
  int size_px = 640;        // of the pictures
  double distance_m = 1.0;  // from the camera to between the eyes
};

// Points of the skin, in the dense mesh's order: means over pictures from several sides of the neutral head, each point then put back
// onto the nearest skin. Throws Error(kModel) when the finder sees no face in the head or the model has no skin.
std::vector<synth::SurfacePoint> locate_dense_landmarks(const synth::HeadModel& model, const face::FaceFinder& finder,
                                                        const DenseLandmarkOptions& options = {});

// What the finder is shown: linear, three channels; yaw and pitch turn the head to its left and up.
Image mannequin_picture(const synth::HeadModel& model, const DenseLandmarkOptions& options, double yaw_deg,
                        double pitch_deg);

}  // namespace faceprobe::pipeline
