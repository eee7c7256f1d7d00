#pragma once
// An estimate as Python holds it: the result with what it was made of, so that it can be saved, reported and used again. Faces, maps and
// arrays share it and keep it alive.

#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/estimate.h"
#include "photo_source.h"

#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::python {

struct Estimated {
  io::Photo photo;
  pipeline::Estimate estimate;
  pipeline::EstimateOptions options;
  std::string source;
};
using EstimatedPtr = std::shared_ptr<Estimated>;

// pipeline::Estimator serves one thread at a time; here threads take turns. Its functions are called without the GIL.
class TurnTaker {
 public:
  explicit TurnTaker(pipeline::EstimateOptions options) : estimator_(std::move(options)) {}

  EstimatedPtr estimate(io::Photo photo, std::string source) const {
    const std::lock_guard<std::mutex> turn(mutex_);
    pipeline::Estimate estimate = estimator_.estimate(photo);
    return std::make_shared<Estimated>(
        Estimated{std::move(photo), std::move(estimate), estimator_.options(), std::move(source)});
  }
  highlight::Layers separate(const io::Photo& photo) const {
    const std::lock_guard<std::mutex> turn(mutex_);
    return estimator_.separate(photo);
  }
  pipeline::LightResult joint(const std::vector<pipeline::FaceEvidence>& faces) const {
    const std::lock_guard<std::mutex> turn(mutex_);
    return estimator_.joint(faces);
  }
  void same_person(std::vector<pipeline::Estimate>& photos) const {
    const std::lock_guard<std::mutex> turn(mutex_);
    estimator_.same_person(photos);
  }

 private:
  pipeline::Estimator estimator_;
  mutable std::mutex mutex_;
};

// Throws Error(kUsage) unless the picture has the size of the estimate's photo.
void check_same_size(const io::Photo& photo, const Estimated& estimated);

}  // namespace faceprobe::python
