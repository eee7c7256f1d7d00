#include "train/photo_view.h"

#include "faceprobe/core/resample.h"
#include "net/close_view.h"
#include "net/torch/picture_tensors.h"

#include <algorithm>

namespace faceprobe::train {
namespace {

// As FaceNet chooses where it looks from near.
Window window_of(const ByteImage& mask, int picture_px) {
  const bool all = std::ranges::all_of(mask.values(), [](std::uint8_t m) { return m != 0; });
  const std::optional<Window> near = all ? std::nullopt : net::close_window(mask, picture_px);
  return near ? *near : net::whole_window(mask.width(), mask.height(), picture_px);
}

Warp seen_through(const Window& window, Warp warp) {
  warp.photo = {window.width, window.height};
  for (Source& source : warp.sources) {
    if (source.reach == Reach::kOutside) continue;
    source.x_px = static_cast<float>((static_cast<double>(source.x_px) - window.left_px) * window.scale);
    source.y_px = static_cast<float>((static_cast<double>(source.y_px) - window.top_px) * window.scale);
    const bool inside = source.x_px >= 0.5F && source.x_px <= static_cast<float>(window.width) - 0.5F &&
                        source.y_px >= 0.5F && source.y_px <= static_cast<float>(window.height) - 0.5F;
    if (source.reach == Reach::kSeen && !inside) source.reach = Reach::kOffPhoto;
  }
  return warp;
}

// As large as `like`, 0 in what is added.
Image enlarged(const Image& image, const Image& like) {
  Image large(like.width(), like.height(), image.channels());
  for (int y = 0; y < image.height(); ++y) std::copy_n(image.pixel(0, y), image.row(y).size(), large.pixel(0, y));
  return large;
}

Image usable_skin(const ByteImage& mask, const ByteImage& clipped) {
  Image skin(mask.width(), mask.height(), 1);
  for (std::size_t i = 0; i < skin.pixel_count(); ++i) {
    const bool usable = mask.data()[i] != 0 && (clipped.empty() || clipped.data()[i] == 0);
    skin.data()[i] = usable ? 1.0F : 0.0F;
  }
  return skin;
}

PhotoView padded(const Image& linear, const ByteImage& clipped, const ByteImage& mask, const Image& mesh, Warp warp,
                 int multiple) {
  PhotoView view{net::pad_picture(linear, clipped, mask, multiple), {}, {}, std::move(warp)};
  view.mesh = enlarged(mesh, view.picture.linear);
  view.skin = enlarged(usable_skin(mask, clipped), view.picture.linear);
  return view;
}

}  // namespace

PhotoView view_of(const PersonPhoto& photo, const ByteImage& mask, const Image& mesh, const ViewOptions& options) {
  if (options.picture_px == 0) return padded(photo.linear, photo.clipped, mask, mesh, photo.warp, options.multiple);
  constexpr std::uint8_t kAllClipped = 7;  // beyond the photo, as in FaceNet
  const Window window = window_of(mask, options.picture_px);
  const ByteImage none(mask.width(), mask.height(), 1);
  return padded(resampled(photo.linear, window),
                resampled(photo.clipped.empty() ? none : photo.clipped, window, kAllClipped), resampled(mask, window),
                resampled(mesh, window), seen_through(window, photo.warp), options.multiple);
}

Batch batch_of(PhotoView& view) {
  Batch batch{net::tensor_view(view.picture.linear),
              net::tensor_view(view.picture.clip),
              net::tensor_view(view.picture.mask),
              {},
              net::tensor_view(view.skin)};
  batch.surface.mesh = net::tensor_view(view.mesh);
  return batch;
}

torch::Tensor in_square(const torch::Tensor& layer, const Warp& warp) {
  const auto count = static_cast<std::int64_t>(warp.sources.size());
  const std::int64_t stride = layer.size(3);
  torch::Tensor places = torch::zeros({4, count}, torch::kLong);
  torch::Tensor weights = torch::zeros({4, count}, torch::kFloat);
  std::int64_t* place = places.data_ptr<std::int64_t>();
  float* weight = weights.data_ptr<float>();
  for (std::int64_t i = 0; i < count; ++i) {
    const Source& source = warp.sources[static_cast<std::size_t>(i)];
    if (source.reach != Reach::kSeen) continue;
    std::int64_t k = 0;
    for (const Corner& corner : corners_of(source, warp.photo)) {
      place[k * count + i] = corner.y * stride + corner.x;
      weight[k * count + i] = corner.weight;
      ++k;
    }
  }
  const torch::Tensor pixels = layer.flatten(2);
  torch::Tensor square = torch::zeros({1, layer.size(1), count}, layer.options());
  for (int k = 0; k < 4; ++k) square = square + pixels.index_select(2, places[k]) * weights[k].to(layer.scalar_type());
  return square;
}

}  // namespace faceprobe::train
