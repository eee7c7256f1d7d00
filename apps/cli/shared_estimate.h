#pragma once
// The estimate of the photo at hand, made once for the rows of a benchmark that ask for it one after the other.

#include "faceprobe/eval/relight_benchmark.h"
#include "faceprobe/pipeline/estimate.h"
#include "relight_methods.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace faceprobe::cli {

class SharedEstimate {
 public:
  // `seen`: what is done to the photo (sRGB) before it is looked at; empty = nothing.
  explicit SharedEstimate(pipeline::EstimateOptions options, std::function<ByteImage(const ByteImage&)> seen = {})
      : estimator_(std::move(options)), seen_(std::move(seen)) {}

  const pipeline::EstimateOptions& options() const { return estimator_.options(); }
  lighting::Light light_of(const lighting::Observations& o) const { return estimator_.light_of(o); }
  // Nothing where no face is found.
  const pipeline::FaceEstimate* of(const eval::LightInput& input);

 private:
  pipeline::Estimator estimator_;
  std::function<ByteImage(const ByteImage&)> seen_;
  std::optional<pipeline::FaceEstimate> found_;
  int known_ = -1;
};

// For pictures as small as the synthetic ones.
pipeline::EstimateOptions estimate_options(const RelightRows& rows);

// The estimate as it is.
eval::LightMethod whole(const std::string& name, const std::shared_ptr<SharedEstimate>& shared);
// The same observations, another way from them to the light.
eval::LightMethod other_solver(const std::string& name, const std::shared_ptr<SharedEstimate>& shared,
                               const std::function<Eigen::MatrixX3f(const lighting::Observations&)>& solve);

}  // namespace faceprobe::cli
