#pragma once
// The work behind the server: photos to light, and things into photos, one after another on one thread.
//
// What stays in memory: the models; of each remembered estimate what things are drawn by (forget_layers in records.h); and the one photo that was
// worked on last, decoded, until its estimate is removed, another photo is worked on, or nothing has been done for some minutes.

#include "serve/records.h"
#include "serve/worker.h"

#include "faceprobe/io/limits.h"
#include "faceprobe/pipeline/insertion.h"
#include "faceprobe/render/material.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>

namespace faceprobe::serve {

struct InsertionRequest {
  std::string object;
  std::string material;              // empty = the object's own
  render::MaterialChange surface{};  // of that
  pipeline::InsertionOptions where;
  bool preview = false;
};

struct StudioOptions {
  pipeline::EstimateOptions estimate;
  io::Limits limits;               // of photos
  std::filesystem::path folder;    // where results go; a folder each
  bool keep = false;               // results, when they are removed or the server ends
  std::size_t history_limit = 12;  // estimates that are remembered
  std::size_t most_waiting = 16;
  std::chrono::milliseconds photo_kept = std::chrono::minutes(5);  // decoded, when nothing is done
};

class Studio {
 public:
  explicit Studio(StudioOptions options);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // `fill` puts the photo where it is told. Throws what that throws, and Refusal(kBusy).
  std::shared_ptr<EstimateRecord> add_photo(const std::string& name,
                                            const std::function<void(const std::filesystem::path&)>& fill);
  // Throws Refusal(kNotFound, kNotReady, kBusy) and Error(kUsage) for what cannot be drawn.
  std::shared_ptr<InsertionRecord> add_insertion(const std::string& estimate, const InsertionRequest& request);

  Records& records() { return records_; }
  bool keeps_photo() const;  // whether one is in memory, decoded

 private:
  // The models and the photo that was worked on last: the worker's own.
  struct Bench;

  StudioOptions options_;
  Records records_;
  std::unique_ptr<Bench> bench_;
  Worker worker_;  // last: it uses the others
};

}  // namespace faceprobe::serve
