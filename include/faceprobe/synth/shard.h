#pragma once
// Samples on disk: a folder of shards, each one .safetensors file that can be mapped into memory, an index, the recipe and a card.
//
//   ShardWriter writer("out", spec);
//   if (!writer.has(3)) writer.write(3, views, samples);      // appears whole or not at all
//   writer.finish(card);
//
//   const ShardReader reader("out");
//   const Sample sample = reader.copy_sample(1234);

#include "faceprobe/io/tensor_file.h"
#include "faceprobe/synth/sample.h"

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::synth {

struct ShardSpec {
  int size_px = 128;
  int environment_height = 32;
  std::string recipe;  // everything the data depends on, one JSON object; a folder made by another recipe is refused
};

// A view and the samples made of it, in order.
struct ViewSamples {
  ViewLayers view;
  std::vector<Sample> samples;
};

class ShardWriter {
 public:
  // Creates the folder. Throws Error(kOutput) when it cannot be written or holds shards of another recipe (the sentence says how the
  // recipes differ).
  ShardWriter(std::filesystem::path folder, ShardSpec spec);
  bool has(int shard) const;  // complete on disk
  // All samples and views in the order given. Thread-safe for different shards.
  void write(int shard, std::span<const ViewSamples> views) const;
  // Writes index.json (shards with their samples and views, and the recipe) and CARD.md.
  void finish(int shard_count, const std::string& card_markdown) const;

 private:
  std::filesystem::path folder_;
  ShardSpec spec_;
};

// What the dense face mesh, found in a view's photos, covers there: what an estimate has to go by. Zero where it is not, and everywhere
// when no face was found.
struct FoundMesh {
  Image normal_cam;  // 3 channels
  ByteImage region;  // 1 channel, Region
};
// Beside shard number `shard` of the folder; of all its views in order. Appears whole or not at all. Throws Error(kOutput).
void write_meshes(const std::filesystem::path& folder, int shard, std::span<const FoundMesh> views);

class ShardReader {
 public:
  // Throws Error(kInput): no index.json, or shards that are not what it says.
  explicit ShardReader(const std::filesystem::path& folder);
  // Several folders as one, sample after sample; the recipe is an array of theirs, in which the numbers of a sample's map and person are those of its
  // own folder. Meshes are there if all have them. Throws Error(kInput) as above, std::invalid_argument without a folder.
  explicit ShardReader(const std::vector<std::filesystem::path>& folders);

  int sample_count() const { return static_cast<int>(place_.size()); }
  const std::string& recipe() const { return recipe_; }
  // The mapped file that holds a sample, and the sample's number in it; for readers that want spans instead of copies.
  std::pair<const io::MappedTensors*, int> place(int sample) const;
  // Copies of sample `number`, 0 .. sample_count() - 1. Throws Error(kInput) for a damaged shard, std::out_of_range for another number.
  Sample copy_sample(int number) const;
  ViewLayers copy_view(int number) const;  // of the view that the sample shows
  // The same with the photo, its clipped pixels and its two layers of light alone, or with regions and faces alone: a third of the bytes.
  Sample copy_light(int number) const;
  ViewLayers copy_faces(int number) const;
  // Number of the person that the sample shows, in a group of the first; -1 where it shows none.
  int person(int number) const;
  // Shard of a sample and number in it of the view it shows.
  std::pair<int, int> view_place(int number) const;

  // Whether `faceprobe mesh` has been here.
  bool has_meshes() const { return !meshes_.empty(); }
  // Of the view that the sample shows. Throws std::out_of_range without meshes.
  FoundMesh copy_mesh(int number) const;

 private:
  int view_of(int number) const;

  std::vector<io::MappedTensors> shards_;
  std::vector<io::MappedTensors> meshes_;   // one a shard, or none
  std::vector<std::pair<int, int>> place_;  // of each sample: shard, number in it
  std::string recipe_;
};

// "shard-00012.safetensors", "mesh-00012.safetensors"
std::string shard_name(int shard);
std::string mesh_name(int shard);

}  // namespace faceprobe::synth
