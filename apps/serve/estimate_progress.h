#pragma once
// How far an estimate is, from the names of the stages that have ended.
//
//   EstimateProgress progress(job);
//   estimator.estimate(photo, [&](std::string_view stage) { progress.ended(stage); });
//
// How many faces there are nobody tells before the last is done: the first is told as if it were the only one, and each further one takes half of
// the way that is left before the files are written. So the share never goes back.

#include "serve/job.h"

#include <string_view>

namespace faceprobe::serve {

// Throws Refusal(kNotFound) when the job is not wanted any more.
void refuse_stopped(const Job& job);

class EstimateProgress {
 public:
  explicit EstimateProgress(Job& job) : job_(job) {}
  // A stage of pipeline::Estimator::estimate; those that are not known are passed over. Throws as refuse_stopped(), which ends the estimate there.
  void ended(std::string_view stage);

 private:
  Job& job_;
  // The part of the whole way that the present face has.
  double begin_ = 0, length_ = 0;
};

}  // namespace faceprobe::serve
