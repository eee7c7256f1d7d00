#pragma once
// What a server remembers until it ends: estimates with their files, and what was drawn into them. Safe from several threads; a record's results
// are written by its job alone, before that has ended, and only read afterwards.

#include "faceprobe/pipeline/estimate.h"
#include "serve/job.h"

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::serve {

struct ServedFile {
  std::string path;  // below the record's folder, with slashes
  std::uintmax_t bytes = 0;
};

// A folder that goes when nobody holds it any more, unless it is to be kept.
class OwnedFolder {
 public:
  OwnedFolder(std::filesystem::path path, bool keep);  // makes it; throws Error(kOutput)
  ~OwnedFolder();
  OwnedFolder(const OwnedFolder&) = delete;
  OwnedFolder& operator=(const OwnedFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  bool kept() const { return keep_; }

 private:
  std::filesystem::path path_;
  bool keep_;
};

struct EstimateRecord {
  EstimateRecord(std::string its_id, std::string its_name, const std::filesystem::path& folder, bool keep)
      : id(std::move(its_id)), name(std::move(its_name)), home(folder / id, keep) {}

  std::filesystem::path photo_file() const { return home.path() / "photo"; }       // as it came
  std::filesystem::path shown_photo() const { return home.path() / "shown.png"; }  // upright, small enough for a page
  std::filesystem::path output() const { return home.path() / "light"; }           // what `faceprobe estimate` leaves

  const std::string id;
  const std::string name;
  const OwnedFolder home;
  Job job;
  mutable std::shared_ptr<const io::Photo> decoded;  // last_photo.h's own
  // From here on results.
  pipeline::Estimate estimate;  // of a record that is done without what forget_layers() takes
  Json described;               // what a client is told of it
  std::vector<ServedFile> files;
};

struct InsertionRecord {
  InsertionRecord(std::string its_id, std::shared_ptr<const EstimateRecord> its_estimate)
      : id(std::move(its_id)), estimate(std::move(its_estimate)),
        home(estimate->home.path() / ("insertion_" + id), estimate->home.kept()) {}

  const std::string id;
  const std::shared_ptr<const EstimateRecord> estimate;
  const OwnedFolder home;
  Job job;
  std::vector<ServedFile> files;  // a result
};

// 16 hexadecimal digits that nobody guesses.
std::string new_id();
// What of an estimate only its files and its description are made of, and which is most of it: pictures of crops, observations and maps of
// confidence. What things are drawn into the photo by stays (pipeline/insertion.h): camera, poses, regions, lights and their maps.
void forget_layers(pipeline::Estimate& estimate);
// All files of a folder, by name.
std::vector<ServedFile> files_of(const std::filesystem::path& folder);

class Records {
 public:
  explicit Records(std::size_t most_estimates, std::size_t most_insertions = 16);

  // The oldest that has ended goes where there are too many, an estimate with its insertions. Throws Refusal(kBusy) when none has.
  void add(const std::shared_ptr<EstimateRecord>& estimate);
  void add(const std::shared_ptr<InsertionRecord>& insertion);  // and Refusal(kNotFound) when its estimate is no more
  // Throw Refusal(kNotFound).
  std::shared_ptr<EstimateRecord> estimate(const std::string& id) const;
  std::shared_ptr<InsertionRecord> insertion(const std::string& id) const;
  std::vector<std::shared_ptr<EstimateRecord>> estimates() const;  // newest first
  // With its insertions, which are stopped.
  void remove_estimate(const std::string& id);
  void remove_insertion(const std::string& id);
  void stop_all();

 private:
  // Stopped and out of the list. Under the lock.
  std::vector<std::shared_ptr<InsertionRecord>> take_insertions_of(const EstimateRecord& estimate);

  mutable std::mutex mutex_;
  std::size_t most_estimates_, most_insertions_;
  std::deque<std::shared_ptr<EstimateRecord>> estimates_;    // oldest first
  std::deque<std::shared_ptr<InsertionRecord>> insertions_;  // the same
};

}  // namespace faceprobe::serve
