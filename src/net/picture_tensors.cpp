#include "net/picture_tensors.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::net {
namespace {

int round_up(int value, int multiple) { return (value + multiple - 1) / multiple * multiple; }

float usable(float light) { return std::isfinite(light) && light > 0 ? light : 0.0F; }

}  // namespace

PaddedPicture pad_picture(const Image& linear, const ByteImage& clip, const ByteImage& mask, int multiple) {
  const int width = round_up(linear.width(), multiple), height = round_up(linear.height(), multiple);
  PaddedPicture result{Image(width, height, 3), Image(width, height, 3), Image(width, height, 1)};
  for (int y = 0; y < height; ++y) {
    const int from_y = std::min(y, linear.height() - 1);
    for (int x = 0; x < width; ++x) {
      const int from_x = std::min(x, linear.width() - 1);
      const unsigned flags = clip.empty() ? 0U : clip(from_x, from_y);
      for (int c = 0; c < 3; ++c) {
        result.linear(x, y, c) = usable(linear(from_x, from_y, c));
        result.clip(x, y, c) = static_cast<float>((flags >> c) & 1U);
      }
      result.mask(x, y) = mask.empty() || mask(from_x, from_y) != 0 ? 1.0F : 0.0F;
    }
  }
  return result;
}

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
