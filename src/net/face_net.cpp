#include "faceprobe/net/face_net.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/mirror.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/face_layers.h"
#include "net/face_outputs.h"
#include "net/head.h"
#include "net/model_info.h"
#include "net/thread_count.h"
#include "net/unet_runner.h"

#include <algorithm>
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

}  // namespace

struct FaceNet::Impl {
  int threads;
  ModelInfo info;
  UNetRunner net;
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
  UNetRunner runner(separator_options(info.options_json, FaceInputs::kCount, FaceOutputs::kCount), list);
  list.finish();
  impl_ = std::make_unique<Impl>(Impl{options.threads, std::move(info), std::move(runner)});
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
  const PaddedPicture picture = pad_picture(linear, clip, mask, impl_->net.options().multiple());
  const FaceInputPicture input = face_input(picture, mesh);
  const Image raw = impl_->net(input.channels);
  FaceLayers layers = surface_of_raw(raw, input.gain, width, height);
  layers.highlight = top_left(highlight_of_raw(raw, picture.linear), width, height);
  const bool grey = is_grey(picture.linear);
  keep_within(layers.highlight, picture.linear, mask, grey);
  if (grey) make_grey(layers.shading);
  return layers;
}

FaceLayers FaceNet::layers_both_ways(const Image& linear, const ByteImage& clip, const ByteImage& mask,
                                     const Image& mesh) const {
  FaceLayers other = layers(mirrored(linear), mirrored(clip), mirrored(mask), mirrored_normals(mesh));
  mirror(other);
  return mean_of(layers(linear, clip, mask, mesh), other);
}

}  // namespace faceprobe::net
