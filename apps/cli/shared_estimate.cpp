#include "shared_estimate.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"

#include <utility>

namespace faceprobe::cli {

using pipeline::FaceEstimate;

const FaceEstimate* SharedEstimate::of(const eval::LightInput& input) {
  if (known_ != input.number) {
    known_ = input.number;
    found_.reset();
    try {
      pipeline::Estimate estimate =
          estimator_.estimate(io::photo_from_srgb(seen_ ? seen_(input.photo.photo) : input.photo.photo));
      found_ = std::move(estimate.faces[estimate.largest]);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kNoFace) throw;
    }
  }
  return found_ ? &*found_ : nullptr;
}

pipeline::EstimateOptions estimate_options(const RelightRows& rows) {
  pipeline::EstimateOptions options;
  options.weights = rows.weights;
  options.prior_weights = rows.prior;
  options.finder.min_face_px = face::kSmallFacePx;
  options.solve.nside = rows.nside;
  options.solve.threads = rows.threads;
  options.threads = rows.threads;
  options.deterministic = true;
  return options;
}

eval::LightMethod whole(const std::string& name, const std::shared_ptr<SharedEstimate>& shared) {
  return {name, [shared](const eval::LightInput& input) {
            const FaceEstimate* face = shared->of(input);
            return face == nullptr ? Eigen::MatrixX3f() : face->light.radiance;
          }};
}

eval::LightMethod other_solver(const std::string& name, const std::shared_ptr<SharedEstimate>& shared,
                               const std::function<Eigen::MatrixX3f(const lighting::Observations&)>& solve) {
  return {name, [shared, solve](const eval::LightInput& input) {
            const FaceEstimate* face = shared->of(input);
            return face == nullptr ? Eigen::MatrixX3f() : solve(face->observations);
          }};
}

}  // namespace faceprobe::cli
