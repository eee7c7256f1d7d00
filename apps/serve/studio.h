#pragma once
// The work behind the server: photos to light, and things into photos, one after another on one thread.

#include "serve/records.h"
#include "serve/worker.h"

#include "faceprobe/io/limits.h"
#include "faceprobe/pipeline/insertion.h"

#include <functional>
#include <memory>
#include <string>

namespace faceprobe::serve {

struct InsertionRequest {
  std::string object;
  std::string material;  // empty = the object's own
  pipeline::InsertionOptions where;
  bool preview = false;
};

struct StudioOptions {
  pipeline::EstimateOptions estimate;
  io::Limits limits;               // of photos
  std::filesystem::path folder;    // where results go; a folder each
  bool keep = false;               // results, when they are removed or the server ends
  std::size_t history_limit = 12;  // an estimate's layers stay in memory
  std::size_t most_waiting = 16;
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

 private:
  // Photos that were decoded last, and the models: the worker's own.
  struct Bench;

  StudioOptions options_;
  Records records_;
  std::unique_ptr<Bench> bench_;
  Worker worker_;  // last: it uses the others
};

}  // namespace faceprobe::serve
