#pragma once
// What an Estimator holds: the options, the networks and the mesh.

#include "faceprobe/net/light_prior.h"
#include "faceprobe/pipeline/estimate.h"
#include "pipeline/face_reader.h"

namespace faceprobe::pipeline {

class Stopwatch;

struct Estimator::Impl {
  explicit Impl(EstimateOptions wanted);
  std::vector<face::Face> faces_of(const io::Photo& photo, const face::Camera& camera) const;
  lighting::Light light_of(const lighting::Observations& observations, bool ask_prior) const;
  lighting::Light light_of(const lighting::Observations& observations, bool ask_prior,
                           const lighting::SolveOptions& solve) const;
  FaceEstimate analyse(const io::Photo& photo, const face::Camera& camera, face::Face found, Stopwatch& watch) const;

  EstimateOptions options;
  face::FaceFinder finder;
  face::CanonicalMesh mesh;
  FaceReader reader;
  std::optional<net::LightPrior> prior;
};

}  // namespace faceprobe::pipeline
