#include "serve/estimate_progress.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::serve {
namespace {

using Stages = std::vector<std::string_view>;

// As pipeline::Estimator tells them.
const Stages kOfAFace = {"geometry", "highlights and normals", "albedo and shading", "light", "maps and main lights"};

// A job's state after each stage of a photo with so many faces.
std::vector<JobState> states_with(int faces) {
  Job job;
  job.progress("Looking for faces", 0.2);
  std::vector<JobState> states = {job.state()};
  EstimateProgress progress(job);
  const auto ended = [&](std::string_view stage) {
    progress.ended(stage);
    states.push_back(job.state());
  };
  ended("find faces");
  for (int face = 0; face < faces; ++face) {
    for (const std::string_view stage : kOfAFace) ended(stage);
  }
  if (faces > 1) ended("joint light");
  return states;
}

TEST(EstimateProgress, NeverGoesBackAndLeavesRoomForTheFiles) {
  for (const int faces : {1, 2, 3, 20}) {
    const std::vector<JobState> states = states_with(faces);
    for (std::size_t i = 1; i < states.size(); ++i)
      EXPECT_GE(states[i].share, states[i - 1].share) << faces << " faces, " << states[i].stage;
    EXPECT_LE(states.back().share, 0.9) << faces;
    EXPECT_GE(states.back().share, 0.7) << faces;
  }
}

TEST(EstimateProgress, EachStageOfEachOfAFewFacesIsAStep) {
  const std::vector<JobState> states = states_with(3);
  for (std::size_t i = 2; i + 1 < states.size(); ++i)
    EXPECT_GT(states[i].share, states[i - 1].share) << states[i].stage;
}

TEST(EstimateProgress, SaysWhatComesNext) {
  const std::vector<JobState> states = states_with(1);
  std::vector<std::string> stages;
  for (const JobState& state : states) stages.push_back(state.stage);
  EXPECT_EQ(stages, (std::vector<std::string>{"Looking for faces", "Measuring the face", "Separating highlights",
                                              "Separating colour from shading", "Solving for the light",
                                              "Drawing the map", "Writing files"}));
}

TEST(EstimateProgress, PassesOverWhatItDoesNotKnow) {
  Job job;
  job.progress("Looking for faces", 0.2);
  EstimateProgress(job).ended("something new");
  EXPECT_EQ(job.state().stage, "Looking for faces");
  EXPECT_EQ(job.state().share, 0.2);
}

TEST(EstimateProgress, AStoppedJobGoesNoFurther) {
  Job job;
  EstimateProgress progress(job);
  progress.ended("find faces");
  EXPECT_NO_THROW(refuse_stopped(job));
  job.stop();
  EXPECT_THROW(progress.ended("geometry"), Refusal);
  EXPECT_THROW(refuse_stopped(job), Refusal);
  EXPECT_EQ(job.state().stage, "Measuring the face");
}

}  // namespace
}  // namespace faceprobe::serve
