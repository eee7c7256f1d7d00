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

FaceRaw split_face_raw(const torch::Tensor& raw) {
  using Out = FaceOutputs;
  if (raw.dim() != 4 || (raw.size(1) != Out::kCount && raw.size(1) != Out::kCountWithoutOpen)) {
    throw std::invalid_argument("face head: the raw output must be N x " + std::to_string(Out::kCount) + " x H x W");
  }
  // Split, as the highlight's channels are (highlight_head.cpp).
  const std::vector<torch::Tensor> parts = raw.split_with_sizes({Out::kNormal, raw.size(1) - Out::kNormal}, 1);
  return {parts[0], parts[1]};
}

FaceSurface surface_from_raw(const torch::Tensor& surface_raw, const torch::Tensor& gain) {
  using Out = FaceOutputs;
  std::vector<std::int64_t> sizes = {3, 1, 1, 1, 3, kRegionCount};
  const bool has_open = surface_raw.dim() == 4 && surface_raw.size(1) == Out::kCount - Out::kNormal;
  if (has_open) sizes.insert(sizes.end(), {1, 3});
  if (surface_raw.dim() != 4 || (!has_open && surface_raw.size(1) != Out::kCountWithoutOpen - Out::kNormal))
    throw std::invalid_argument("face head: the surface's channels must be those that split_face_raw() gives");
  const std::vector<torch::Tensor> parts = surface_raw.to(torch::kFloat).split_with_sizes(sizes, 1);
  const auto limited = [](const torch::Tensor& x) { return x.clamp(-Head::kLargestRaw, Head::kLargestRaw); };
  const torch::Tensor towards_viewer = torch::tensor({0.0F, 0.0F, 1.0F}, parts[0].options()).view({1, 3, 1, 1});
  const torch::Tensor free = limited(parts[0]) + towards_viewer;
  const torch::Tensor length = free.square().sum(1, true).clamp_min(Out::kShortest * Out::kShortest).sqrt();
  const auto logarithm = [](const torch::Tensor& x) { return x.clamp(-Out::kLargestLog, Out::kLargestLog); };
  const auto colour_of = [&limited](const torch::Tensor& x) {
    const torch::Tensor colour = torch::softplus(limited(x)) + Head::kColourFloor;
    return colour / colour.mean(1, true);
  };
  FaceSurface surface{free / length,       Out::kUsualError * logarithm(parts[1]).exp(),
                      limited(parts[2]),   logarithm(parts[3]) - gain.log(),
                      colour_of(parts[4]), limited(parts[5])};
  if (has_open) {
    surface.open_log_level = logarithm(parts[6]) - gain.log();
    surface.open_colour = colour_of(parts[7]);
  }
  return surface;
}

}  // namespace faceprobe::net
