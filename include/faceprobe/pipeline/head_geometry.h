#pragma once
// A face's surface from a head model that statistics know: shape and expression are fitted to the 468 landmarks, and the model's own finer
// surface takes the place of the mesh's. The third way to normals, beside the mesh and the network (docs/measurements.md tells how good each is).
//
//   synth::HeadModel model = assets::load_ict_head("ict_facekit");
//   EstimateOptions options;
//   options.normals = NormalSource::kFit;
//   options.surface_fit = head_geometry(std::move(model), face::FaceFinder());
//   const Estimator estimator(options);
//
// Not for best accuracy on ordinary photos: the network's normals are nearer. Of use where the network is not wanted, and for positions:
// they are the fitted head's.

#include "faceprobe/face/face.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/synth/head_model.h"

namespace faceprobe::pipeline {

// The fit of one model, for EstimateOptions::surface_fit; each call fits one face (Gauss-Newton in perspective from the finder's pose, a
// standard deviation of ridge on identity and expression), bends the picture of the model onto the landmarks and draws its skin where the mesh
// has face. A model without dense landmarks is shown to `finder` once, to learn where they are; where that finds no face, its 68 landmarks
// have to do. `threads`: 0 = all. Throws Error(kModel) for a model without skin or landmarks.
face::SurfaceFit head_geometry(synth::HeadModel model, const face::FaceFinder& finder, int threads = 0);

}  // namespace faceprobe::pipeline
