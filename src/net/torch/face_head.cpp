#include "net/torch/face_head.h"

#include "net/face_outputs.h"
#include "net/head.h"
#include "net/torch/highlight_head.h"

#include <stdexcept>
#include <vector>

namespace faceprobe::net {

FaceInput prepare_face_input(const torch::Tensor& linear, const torch::Tensor& clip, const torch::Tensor& mask,
                             const torch::Tensor& mesh) {
  if (mesh.dim() != 4 || mesh.size(1) != 3)
    throw std::invalid_argument("face head: the mesh's normals must be N x 3 x H x W");
  const torch::Tensor light = luminance(linear).clamp(0, Head::kBrightest);
  const torch::Tensor faces = mask.sum({1, 2, 3}, true);
  const torch::Tensor weight = torch::where(faces > 0, mask, torch::ones_like(mask));
  const torch::Tensor mean = (light * weight).sum({1, 2, 3}, true) / weight.sum({1, 2, 3}, true);
  const torch::Tensor gain = FaceInputs::kMiddle / mean.clamp_min(FaceInputs::kDarkest);
  return {torch::cat({prepare_input(linear * gain, clip, mask), mesh.to(linear.scalar_type())}, 1), gain};
}

FaceSurface surface_from_raw(const torch::Tensor& raw, const torch::Tensor& gain) {
  using Out = FaceOutputs;
  if (raw.dim() != 4 || (raw.size(1) != Out::kCount && raw.size(1) != Out::kCountWithoutOpen)) {
    throw std::invalid_argument("face head: the raw output must be N x " + std::to_string(Out::kCount) + " x H x W");
  }
  const torch::Tensor full = raw.to(torch::kFloat).clamp(-Head::kLargestRaw, Head::kLargestRaw);
  const torch::Tensor towards_viewer = torch::tensor({0.0F, 0.0F, 1.0F}, full.options()).view({1, 3, 1, 1});
  // Split, as the highlight's channels are (highlight_head.cpp).
  const bool has_open = raw.size(1) == Out::kCount;
  std::vector<std::int64_t> sizes = {Out::kNormal, 3, 1, 1, 1, 3, kRegionCount};
  if (has_open) sizes.insert(sizes.end(), {1, 3});
  const std::vector<torch::Tensor> parts = full.split_with_sizes(sizes, 1);
  const torch::Tensor free = parts[1] + towards_viewer;
  const torch::Tensor length = free.square().sum(1, true).clamp_min(Out::kShortest * Out::kShortest).sqrt();
  const auto logarithm = [](const torch::Tensor& x) { return x.clamp(-Out::kLargestLog, Out::kLargestLog); };
  const auto colour_of = [](const torch::Tensor& x) {
    const torch::Tensor colour = torch::softplus(x) + Head::kColourFloor;
    return colour / colour.mean(1, true);
  };
  FaceSurface surface{free / length,
                      Out::kUsualError * logarithm(parts[2]).exp(),
                      parts[3],
                      logarithm(parts[4]) - gain.log(),
                      colour_of(parts[5]),
                      parts[6]};
  if (has_open) {
    surface.open_log_level = logarithm(parts[7]) - gain.log();
    surface.open_colour = colour_of(parts[8]);
  }
  return surface;
}

}  // namespace faceprobe::net
