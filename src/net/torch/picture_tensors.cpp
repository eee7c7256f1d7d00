#include "net/torch/picture_tensors.h"

#include <algorithm>

namespace faceprobe::net {

torch::Tensor tensor_view(Image& picture) {
  return torch::from_blob(picture.data(), {1, picture.height(), picture.width(), picture.channels()}, torch::kFloat32)
      .permute({0, 3, 1, 2});
}

Image crop_to_picture(const torch::Tensor& tensor, int width, int height) {
  const torch::Tensor cropped = tensor.narrow(2, 0, height).narrow(3, 0, width);
  const torch::Tensor interleaved = cropped.permute({0, 2, 3, 1}).to(torch::kCPU, torch::kFloat32).contiguous();
  Image picture(width, height, 3);
  std::copy_n(interleaved.data_ptr<float>(), picture.values().size(), picture.data());
  return picture;
}

}  // namespace faceprobe::net
