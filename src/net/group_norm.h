#pragma once
// Group norm (Wu & He 2018) with the SiLU that follows it everywhere in our networks: x -> y sigmoid(y), y = norm(x) weight + bias.

#include "faceprobe/core/image.h"
#include "net/weight_list.h"

#include <string>
#include <vector>

namespace faceprobe::net {

class GroupNormSilu {
 public:
  // `name`.weight and `name`.bias, one number a channel; `channels` a multiple of kNormGroups. Throws Error(kModel).
  GroupNormSilu(WeightList& weights, const std::string& name, int channels);

  // In place; the statistics are taken over the whole of each group of neighbouring channels.
  void apply(Image& features) const;

 private:
  std::vector<float> weight_, bias_;
};

}  // namespace faceprobe::net
