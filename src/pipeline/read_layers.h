#pragma once
// From a face's picture and mesh to its layers and what they say about the light: everything that comes before the solver.

#include "pipeline/face_reader.h"

namespace faceprobe::pipeline {

class Stopwatch;

// Of `face`, geometry (the mesh's), picture and clipped are given; layers, albedo, shading, light colour, observations and the sources of these
// are found, and the geometry takes the network's or the fitted model's normals, and the network's regions. `camera`: the photo's; `grey`: the photo has no colour. `enough` of the face is shown (face_reader.h).
void read_layers(const FaceReader& reader, const EstimateOptions& options, const face::Camera& camera, bool grey,
                 bool enough, FaceEstimate& face, Stopwatch* watch = nullptr);

}  // namespace faceprobe::pipeline
