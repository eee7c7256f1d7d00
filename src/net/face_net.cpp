#include "faceprobe/net/face_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/mirror.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/close_view.h"
#include "net/face_layers.h"
#include "net/face_outputs.h"
#include "net/head.h"
#include "net/model_info.h"
#include "net/thread_count.h"
#include "net/unet_runner.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>
#include <utility>

namespace faceprobe::net {
namespace {

// A grey photo says nothing of the light's colour.
void make_grey(Image& image) {
  for (std::size_t i = 0; i < image.values().size(); i += 3) {
    float* pixel = image.data() + i;
    std::fill_n(pixel, 3, (pixel[0] + pixel[1] + pixel[2]) / 3);
  }
}

struct Seen {
  Image linear;
  ByteImage clip, mask;
  Image mesh;
};

// As training pictures are seen (train/augment_view.h).
Seen seen_through(const Window& window, const Image& linear, const ByteImage& clip, const ByteImage& mask,
                  const Image& mesh) {
  constexpr std::uint8_t kAllClipped = 7;
  const ByteImage none(linear.width(), linear.height(), 1);
  return {resampled(linear, window), resampled(clip.empty() ? none : clip, window, kAllClipped),
          mask.empty() ? ByteImage() : resampled(mask, window), mesh.empty() ? Image() : resampled(mesh, window)};
}

bool shows_all(const ByteImage& mask) {
  return std::ranges::all_of(mask.values(), [](std::uint8_t m) { return m != 0; });
}

// Those of weights from before there was an open shading as well.
UNetOptions face_options(const std::string& json) {
  const bool without = unet_options_from_json(json).out_channels == FaceOutputs::kCountWithoutOpen;
  return separator_options(json, FaceInputs::kCount, without ? FaceOutputs::kCountWithoutOpen : FaceOutputs::kCount);
}

int picture_px_of(const ModelInfo& info) {
  const auto found = info.metadata.find(kPictureKey);
  if (found == info.metadata.end()) return 0;
  int px = 0;
  const char* end = found->second.data() + found->second.size();
  const auto [rest, problem] = std::from_chars(found->second.data(), end, px);
  if (problem == std::errc() && rest == end && px >= 8 && px <= 1024) return px;
  throw Error(ExitCode::kModel, "The weights' " + std::string(kPictureKey) + " is " + io::quoted(found->second) +
                                    "; allowed is 8 to 1024. Use weights made for faceprobe.");
}

}  // namespace

struct FaceNet::Impl {
  int threads;
  int picture_px;  // side of the views it was trained on; 0 = pictures as they come
  ModelInfo info;
  UNetRunner net;

  // What it sees in a picture as it is. Not empty.
  FaceLayers look(const Image& linear, const ByteImage& clip, const ByteImage& mask, const Image& mesh) const {
    const PaddedPicture picture = pad_picture(linear, clip, mask, net.options().multiple());
    const FaceInputPicture input = face_input(picture, mesh);
    const Image raw = net(input.channels);
    FaceLayers layers = surface_of_raw(raw, input.gain, linear.width(), linear.height());
    layers.highlight = top_left(highlight_of_raw(raw, picture.linear), linear.width(), linear.height());
    return layers;
  }

  // The same through a window.
  FaceLayers look(const Window& window, const Image& linear, const ByteImage& clip, const ByteImage& mask,
                  const Image& mesh) const {
    const Seen seen = seen_through(window, linear, clip, mask, mesh);
    return look(seen.linear, seen.clip, seen.mask, seen.mesh);
  }
};

std::string FaceNetOptions::validate() const {
  if (threads < 0) return "threads is " + std::to_string(threads) + "; it must be 0 (all processors) or more.";
  return {};
}

FaceNet::FaceNet(const std::filesystem::path& weights, const FaceNetOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const io::TensorFile file = io::read_safetensors(weights);
  ModelInfo info = model_info(file, weights.string());
  if (info.architecture != kFaceArchitecture) {
    throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                      "; a face's layers come from face. Use weights made for it.");
  }
  WeightList list(file);
  UNetRunner runner(face_options(info.options_json), list);
  list.finish();
  const int picture_px = picture_px_of(info);
  impl_ = std::make_unique<Impl>(Impl{options.threads, picture_px, std::move(info), std::move(runner)});
}

FaceNet::FaceNet(FaceNet&&) noexcept = default;
FaceNet& FaceNet::operator=(FaceNet&&) noexcept = default;
FaceNet::~FaceNet() = default;

const ModelInfo& FaceNet::info() const { return impl_->info; }

FaceLayers FaceNet::layers(const Image& linear, const ByteImage& clip, const ByteImage& mask, const Image& mesh) const {
  check_sizes(linear, clip, mask);
  if (!mesh.empty() && (mesh.channels() != 3 || mesh.width() != linear.width() || mesh.height() != linear.height()))
    throw std::invalid_argument("The mesh's normals must have three channels and the picture's size");
  const int width = linear.width();
  const int height = linear.height();
  if (linear.empty()) {
    FaceLayers none = surface_of_raw({}, 1, width, height);
    none.highlight = Image(width, height, 3);
    return none;
  }
  const ThreadCount threads(impl_->threads);
  const Image light = pad_picture(linear, {}, {}, 1).linear;  // no not-a-numbers, which resampling would spread
  FaceLayers layers;
  if (impl_->picture_px == 0) {
    layers = impl_->look(light, clip, mask, mesh);
  } else {
    const Window all = whole_window(width, height, impl_->picture_px);
    layers = seen_back(impl_->look(all, light, clip, mask, mesh), all, width, height);
    const std::optional<Window> near = shows_all(mask) ? std::nullopt : close_window(mask, impl_->picture_px);
    if (near) put_near(impl_->look(*near, light, clip, mask, mesh), *near, mask, layers);
  }
  const bool grey = is_grey(light);
  keep_within(layers.highlight, light, mask, grey);
  if (grey) make_grey(layers.shading);
  if (grey) make_grey(layers.open_shading);
  return layers;
}

FaceLayers FaceNet::layers_both_ways(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                                     const Image& mesh) const {
  FaceLayers other = layers(mirrored(linear), mirrored(clip), mirrored(mask), mirrored_normals(mesh));
  mirror(other);
  return mean_of(layers(linear, clip, mask, mesh), other);
}

}  // namespace faceprobe::net
