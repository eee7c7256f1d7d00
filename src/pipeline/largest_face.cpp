#include "faceprobe/pipeline/largest_face.h"

#include "faceprobe/core/error.h"

#include <utility>

namespace faceprobe::pipeline {

std::optional<FaceEstimate> find_largest_face(const Estimator& estimator, const io::Photo& photo) {
  try {
    Estimate estimate = estimator.estimate(photo);
    return std::move(estimate.faces[estimate.largest]);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kNoFace) throw;
    return std::nullopt;
  }
}

}  // namespace faceprobe::pipeline
