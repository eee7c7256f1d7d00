#include "net/weight_list.h"

#include "faceprobe/core/error.h"
#include "io/safetensors_header.h"

namespace faceprobe::net {

std::vector<float> WeightList::take(const std::string& name, const std::vector<std::int64_t>& shape) {
  const io::Tensor& tensor = file_.tensor(name, shape);
  taken_.insert(name);
  return tensor.values;
}

void WeightList::finish() const {
  for (const auto& [name, tensor] : file_.tensors) {
    if (taken_.contains(name)) continue;
    throw Error(ExitCode::kModel, "The weights hold tensor " + io::quoted(name) + " of shape " +
                                      io::shape_text(tensor.shape) + ", one of " + std::to_string(file_.tensors.size()) +
                                      ", where the network has " + std::to_string(taken_.size()) +
                                      " tensors and none of that name. They belong to another network or version.");
  }
}

}  // namespace faceprobe::net
