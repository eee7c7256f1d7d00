#pragma once
// Beside a shard: what an estimate read from each of its photos, and the light that was true; the examples of the light prior's training.
//
//   write_traced("faces/train", 12, examples);
//   const std::vector<TracedPhoto> all = read_traced("faces/train");

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

namespace faceprobe::synth {

struct TracedPhoto {
  Eigen::VectorXf features;  // lighting::face_features
  Eigen::MatrixX3f light;  // #cells of lighting::kFeatureNside x 3, camera frame, over the shading's level as it was read
};

// All of one size. Appears whole or not at all. Throws Error(kOutput).
void write_traced(const std::filesystem::path& folder, int shard, std::span<const TracedPhoto> photos);
// Those of all shards, in order; empty when there are none. Throws Error(kInput): damaged.
std::vector<TracedPhoto> read_traced(const std::filesystem::path& folder);

// "traced-00012.safetensors"
std::string traced_name(int shard);

}  // namespace faceprobe::synth
