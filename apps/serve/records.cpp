#include "serve/records.h"

#include "faceprobe/io/atomic_file.h"

#include <algorithm>
#include <array>
#include <random>
#include <system_error>
#include <utility>

namespace faceprobe::serve {
namespace {

// What had to go, which the caller lets go of when the lock is off: its folder goes with it.
template <class Record>
std::shared_ptr<Record> make_room(std::deque<std::shared_ptr<Record>>& records, std::size_t most) {
  if (records.size() < most) return nullptr;
  const auto old = std::ranges::find_if(records, [](const auto& record) { return record->job.state().ended(); });
  if (old == records.end())
    throw Refusal(FailureKind::kBusy,
                  "There is as much work waiting as this server takes; try again when some is done.");
  std::shared_ptr<Record> gone = *old;
  records.erase(old);
  return gone;
}

template <class Record>
std::shared_ptr<Record> find(const std::deque<std::shared_ptr<Record>>& records, const std::string& id,
                             const char* what) {
  const auto found = std::ranges::find_if(records, [&](const auto& record) { return record->id == id; });
  if (found == records.end())
    throw Refusal(FailureKind::kNotFound,
                  "There is no " + std::string(what) + " " + id +
                      ": it was removed, or made room for newer ones, or the server was started anew.");
  return *found;
}

}  // namespace

OwnedFolder::OwnedFolder(std::filesystem::path path, bool keep) : path_(std::move(path)), keep_(keep) {
  io::create_folder(path_);
}

OwnedFolder::~OwnedFolder() {
  std::error_code ignored;
  if (!keep_) std::filesystem::remove_all(path_, ignored);
}

std::string new_id() {
  std::random_device source;
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string id;
  for (int word = 0; word < 2; ++word) {
    unsigned bits = source();
    for (int i = 0; i < 8; ++i, bits >>= 4) id += kDigits[bits & 15U];
  }
  return id;
}

void forget_layers(pipeline::Estimate& estimate) {
  for (pipeline::FaceEstimate& face : estimate.faces) {
    for (Image* picture : {&face.geometry.normal_cam, &face.geometry.position_cam_m, &face.geometry.view_cam,
                           &face.geometry.normal_error_rad, &face.picture, &face.layers.highlight, &face.layers.diffuse,
                           &face.albedo, &face.shading})
      *picture = {};
    face.clipped = {};
    face.observations = {};
    face.confidence = {};
  }
  if (estimate.joint) estimate.joint->confidence = {};
}

std::vector<ServedFile> files_of(const std::filesystem::path& folder) {
  std::vector<ServedFile> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files.push_back({std::filesystem::relative(entry.path(), folder).generic_string(), entry.file_size()});
  }
  std::ranges::sort(files, {}, &ServedFile::path);
  return files;
}

Records::Records(std::size_t most_estimates, std::size_t most_insertions)
    : most_estimates_(most_estimates), most_insertions_(most_insertions) {}

void Records::add(const std::shared_ptr<EstimateRecord>& estimate) {
  std::shared_ptr<EstimateRecord> gone;
  std::vector<std::shared_ptr<InsertionRecord>> with_it;
  const std::lock_guard lock(mutex_);
  gone = make_room(estimates_, most_estimates_);
  if (gone) with_it = take_insertions_of(*gone);
  estimates_.push_back(estimate);
}

void Records::add(const std::shared_ptr<InsertionRecord>& insertion) {
  std::shared_ptr<InsertionRecord> gone;
  const std::lock_guard lock(mutex_);
  find(estimates_, insertion->estimate->id, "estimate");  // removed meanwhile?
  gone = make_room(insertions_, most_insertions_);
  insertions_.push_back(insertion);
}

std::shared_ptr<EstimateRecord> Records::estimate(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return find(estimates_, id, "estimate");
}

std::shared_ptr<InsertionRecord> Records::insertion(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  return find(insertions_, id, "insertion");
}

std::vector<std::shared_ptr<EstimateRecord>> Records::estimates() const {
  const std::lock_guard lock(mutex_);
  return {estimates_.rbegin(), estimates_.rend()};
}

std::vector<std::shared_ptr<InsertionRecord>> Records::take_insertions_of(const EstimateRecord& estimate) {
  std::vector<std::shared_ptr<InsertionRecord>> taken;
  std::erase_if(insertions_, [&](const auto& insertion) {
    if (insertion->estimate.get() != &estimate) return false;
    insertion->job.stop();
    taken.push_back(insertion);
    return true;
  });
  return taken;
}

void Records::remove_estimate(const std::string& id) {
  std::shared_ptr<EstimateRecord> gone;
  std::vector<std::shared_ptr<InsertionRecord>> with_it;
  const std::lock_guard lock(mutex_);
  gone = find(estimates_, id, "estimate");
  gone->job.stop();
  std::erase(estimates_, gone);
  with_it = take_insertions_of(*gone);
}

void Records::remove_insertion(const std::string& id) {
  std::shared_ptr<InsertionRecord> gone;
  const std::lock_guard lock(mutex_);
  gone = find(insertions_, id, "insertion");
  gone->job.stop();
  std::erase(insertions_, gone);
}

void Records::stop_all() {
  const std::lock_guard lock(mutex_);
  for (const auto& estimate : estimates_) estimate->job.stop();
  for (const auto& insertion : insertions_) insertion->job.stop();
}

}  // namespace faceprobe::serve
