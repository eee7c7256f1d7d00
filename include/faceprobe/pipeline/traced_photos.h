#pragma once
// Reads the photos of a synthetic data set as an estimate reads anybody's, and leaves what was read beside the shards with the light that was
// true (synth/traced.h): the examples that the light prior is trained on (net/light_prior.h). The data need their meshes
// (pipeline/found_meshes.h); photos in which no mesh was found, or that show too little skin, give no example.
//
//   const pipeline::TraceCount count = pipeline::trace_photos("faces/train", {.most = 12000});

#include "faceprobe/pipeline/estimate.h"

#include <filesystem>
#include <functional>

namespace faceprobe::pipeline {

struct TraceRun {
  int most = 1'000'000;     // photos to read, spread evenly over the data set
  EstimateOptions options;  // weights and threads; the solver is not run
};

struct TraceCount {
  int photos = 0;
  int traced = 0;
};

// Shards that have been read are left as they are. `progress`: shards done, of how many. Throws Error(kInput) for no data set or one without
// meshes, Error(kOutput) when it cannot be written to.
TraceCount trace_photos(const std::filesystem::path& folder, const TraceRun& run,
                        const std::function<void(int, int)>& progress = {});

}  // namespace faceprobe::pipeline
