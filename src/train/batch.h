#pragma once
// Internal: samples made ready for a network, several at a time, on threads beside the training. Which samples make up step s, and how
// they are changed, depends on the seed and s alone.

#include "faceprobe/synth/shard.h"
#include "faceprobe/train/config.h"

#include <torch/torch.h>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace faceprobe::train {

// What the face network is given and is to find beside the highlights, and shi and albedo_shading learn the shading from; undefined tensors for the others.
struct SurfaceBatch {
  torch::Tensor mesh;     // N x 3 x H x W: normals of the mesh that was found, 0 off it; given to the network
  torch::Tensor normal;   // N x 3 x H x W, camera frame; of any length
  torch::Tensor depth_m;  // N x 1 x H x W
  torch::Tensor weight;   // N x 1 x H x W: of the normal and the depth there
  torch::Tensor region;   // N x 1 x H x W: the Region's number
  torch::Tensor shading;  // N x 3 x H x W
  torch::Tensor lit;      // N x 1 x H x W of 0 and 1: where the shading is known and can be seen
  torch::Tensor open;     // N x 3 x H x W: open_shading.h; 0 where it is not known

  bool there() const { return normal.defined(); }
};

// N pictures of H x W. Float, channels-last, on the processor.
struct Batch {
  torch::Tensor linear;       // N x 3 x H x W
  torch::Tensor clip;         // N x 3 x H x W of 0 and 1
  torch::Tensor mask;         // N x 1 x H x W of 0 and 1
  torch::Tensor highlight;    // N x 3 x H x W
  torch::Tensor skin;         // N x 1 x H x W of 0 and 1: where errors count whole
  SurfaceBatch surface = {};  // for the face network, shi and albedo_shading
};

// Throws Error(kInput) when the data lack the meshes, or the shading, that the config's network is trained with.
void require_meshes(const synth::ShardReader& reader, const std::filesystem::path& folder, const TrainConfig& config);

// Samples without changes by chance, for validation.
Batch plain_batch(const synth::ShardReader& reader, const std::vector<int>& samples, const TrainConfig& config);

// The samples of a step: a new order of all of them in each round through the data.
std::vector<int> samples_of_step(std::uint64_t seed, std::int64_t step, int batch, int sample_count);

// Threads that make batches: one beside a processor, where a sample takes a fiftieth of a step's time, more beside a card.
int usual_workers(bool on_card);

// Makes batches ahead, on `workers` threads, 1 or more; the batches and their order are the same with any number. `repeat` gives the first one again and again: what a step costs when data costs nothing.
class BatchSource {
 public:
  BatchSource(const synth::ShardReader& reader, const TrainConfig& config, std::int64_t first_step, bool repeat = false,
              int workers = 1);
  ~BatchSource();
  BatchSource(const BatchSource&) = delete;
  BatchSource& operator=(const BatchSource&) = delete;

  // That of the next step. Rethrows what went wrong while it was made.
  Batch next();

 private:
  void work();

  const synth::ShardReader& reader_;
  TrainConfig config_;
  bool repeat_;
  std::int64_t ahead_;   // batches that lie ready at most
  std::int64_t wanted_;  // step that next() gives
  std::int64_t started_;
  std::map<std::int64_t, Batch> ready_;
  std::exception_ptr failure_;
  bool stop_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::jthread> workers_;  // last, so that they end first
};

}  // namespace faceprobe::train
