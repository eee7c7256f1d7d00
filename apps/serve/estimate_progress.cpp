#include "serve/estimate_progress.h"

#include <algorithm>
#include <array>
#include <string>

namespace faceprobe::serve {
namespace {

// Shares of the whole way (measured on a 12-megapixel portrait): before the faces, with one of them, and with all there can be.
constexpr double kFacesFound = 0.4;
constexpr double kOneFace = 0.7;
constexpr double kAllFaces = 0.9;

// What comes after a stage that has ended, for people, and how far that is on the way of one face.
struct NextStage {
  std::string_view after, what;
  double of_face;
};
constexpr std::array kStages = {
    NextStage{"find faces", "Measuring the face", 0},
    NextStage{"geometry", "Separating highlights", 0.17},
    NextStage{"highlights and normals", "Separating colour from shading", 0.33},
    NextStage{"albedo and shading", "Solving for the light", 0.5},
    NextStage{"light", "Drawing the map", 0.83},
    NextStage{"maps and main lights", "Writing files", 1},
    NextStage{"joint light", "Writing files", 0},
};

}  // namespace

void refuse_stopped(const Job& job) {
  if (job.stopped()) throw Refusal(FailureKind::kNotFound, "It was stopped.");
}

void EstimateProgress::ended(std::string_view stage) {
  refuse_stopped(job_);
  const auto* next = std::ranges::find(kStages, stage, &NextStage::after);
  if (next == kStages.end()) return;
  if (stage == "find faces") {
    begin_ = kFacesFound;
    length_ = kOneFace - kFacesFound;
  }
  job_.progress(std::string(next->what), begin_ + next->of_face * length_);
  if (stage == "maps and main lights") {
    begin_ += length_;
    length_ = (kAllFaces - begin_) / 2;
  }
}

}  // namespace faceprobe::serve
