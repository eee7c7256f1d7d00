#pragma once
// The tensors of a weights file, taken out one by one. What is left at the end belongs to another network.

#include "faceprobe/io/safetensors.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace faceprobe::net {

class WeightList {
 public:
  // `file` must outlive the list.
  explicit WeightList(const io::TensorFile& file) : file_(file) {}

  // Throws Error(kModel): missing, or of another shape.
  std::vector<float> take(const std::string& name, const std::vector<std::int64_t>& shape);
  // Throws Error(kModel) that names a tensor which nobody took.
  void finish() const;

 private:
  const io::TensorFile& file_;
  std::set<std::string> taken_;
};

}  // namespace faceprobe::net
