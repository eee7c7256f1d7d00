#include "faceprobe/net/light_regressor.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/model_info.h"
#include "net/torch/light_cnn.h"
#include "net/torch/picture_tensors.h"
#include "net/torch/weights.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::net {
namespace {

using RowCells = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

Eigen::MatrixX3f cells_of(const torch::Tensor& rows) {
  const torch::Tensor plain = rows.reshape({-1, 3}).contiguous();
  return Eigen::Map<const RowCells>(plain.data_ptr<float>(), plain.size(0), 3);
}

// 1 x 3 x H x 2H
Eigen::MatrixX3f cells_of_panorama(const torch::Tensor& radiance, const SphereGrid& grid) {
  const torch::Tensor rows = radiance[0].permute({1, 2, 0}).contiguous();
  Image picture(static_cast<int>(rows.size(1)), static_cast<int>(rows.size(0)), 3);
  std::copy_n(rows.data_ptr<float>(), rows.numel(), picture.data());
  return grid_from_env_map(EnvMap(std::move(picture)), grid);
}

}  // namespace

struct LightRegressor::Impl {
  LightCnnOptions options;
  ModelInfo info;
  GardnerNet gardner = nullptr;  // one of the two
  LegendreNet legendre = nullptr;
};

LightRegressor::LightRegressor(const std::filesystem::path& weights) : impl_(std::make_unique<Impl>()) {
  const io::TensorFile file = io::read_safetensors(weights);
  impl_->info = model_info(file, weights.string());
  const std::string& architecture = impl_->info.architecture;
  const bool gardner = architecture == kGardnerArchitecture;
  if (!gardner && architecture != kLegendreArchitecture) {
    throw Error(ExitCode::kModel,
                "The weights are of a network " + io::quoted(architecture) +
                    "; light is regressed by gardner and legendre. Use weights made for one of them.");
  }
  impl_->options = light_cnn_options_from_json(impl_->info.options_json);
  const auto load = [&file](auto& net) {
    load_weights(*net, file);
    net->eval();
  };
  try {
    if (gardner) {
      impl_->gardner = GardnerNet(impl_->options);
      load(impl_->gardner);
    } else {
      impl_->legendre = LegendreNet(impl_->options);
      load(impl_->legendre);
    }
  } catch (const std::invalid_argument& problem) {
    throw Error(ExitCode::kModel, "The options of the network " + io::quoted(architecture) +
                                      " cannot be used: " + problem.what() + " Use the file as it was written.");
  }
}

LightRegressor::LightRegressor(LightRegressor&&) noexcept = default;
LightRegressor& LightRegressor::operator=(LightRegressor&&) noexcept = default;
LightRegressor::~LightRegressor() = default;

int LightRegressor::picture_px() const { return impl_->options.picture_px; }
const ModelInfo& LightRegressor::info() const { return impl_->info; }

Eigen::MatrixX3f LightRegressor::light(const Image& linear_crop) const {
  if (linear_crop.empty() || linear_crop.channels() != 3 || linear_crop.width() != linear_crop.height())
    throw std::invalid_argument("LightRegressor: the crop must be square with three channels");
  const int px = impl_->options.picture_px;
  const double scale = static_cast<double>(px) / linear_crop.width();
  Image picture = resampled(linear_crop, {.scale = scale, .width = px, .height = px}, Outside::kEdge);
  for (float& value : picture.values()) value = srgb_from_linear(value > 0 ? std::min(value, 1.0F) : 0.0F);

  const torch::NoGradGuard no_grad;
  const torch::Tensor input = tensor_view(picture);
  const SphereGrid grid(kNside);
  if (!impl_->gardner.is_empty()) return cells_of_panorama(impl_->gardner->radiance(input), grid);
  return grid_from_grid(cells_of(impl_->legendre->forward(input).exp()), SphereGrid(impl_->options.light_size), grid);
}

}  // namespace faceprobe::net
