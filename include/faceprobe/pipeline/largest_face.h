#pragma once
// The largest face of a photo, or nothing: for going through many photos, of which one without a face is no error.
//
//   const Estimator estimator{{}};
//   if (const auto face = find_largest_face(estimator, io::load_photo("portrait.jpg"))) use(face->environment);
//
// Estimator::estimate() is for a photo that somebody gave: it says why there is no face.

#include "faceprobe/pipeline/estimate.h"

#include <optional>

namespace faceprobe::pipeline {

// Everything that Estimator::estimate() found of it; nothing when the photo shows no face. Throws as that does for all else.
std::optional<FaceEstimate> find_largest_face(const Estimator& estimator, const io::Photo& photo);

}  // namespace faceprobe::pipeline
