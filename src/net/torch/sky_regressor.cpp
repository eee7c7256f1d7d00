#include "faceprobe/net/sky_regressor.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/core/sun_bins.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/model_info.h"
#include "net/torch/sky_cnn.h"
#include "net/torch/weights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace faceprobe::net {
namespace {

constexpr double kLeastExposure = 1e-6;
constexpr double kMostExposure = 1e6;

ModelInfo checked_sky_info(const io::TensorFile& file, const std::string& name) {
  ModelInfo info = model_info(file, name);
  if (info.architecture != kSkyArchitecture) {
    throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                      "; outdoor light is told by sky. Use weights made for it.");
  }
  return info;
}

double luminance_of(const Eigen::Vector3d& rgb) { return rgb.dot(luminance_weights<double>()); }

// 1 x 3 x px x px, as the network has it.
torch::Tensor picture_of(const Image& linear_crop, int px) {
  const Window whole{.scale = static_cast<double>(px) / linear_crop.width(), .width = px, .height = px};
  const ByteImage encoded =
      encode_srgb(linear_crop.width() == px ? linear_crop : resampled(linear_crop, whole, Outside::kEdge));
  torch::Tensor bytes = torch::empty({1, px, px, 3}, torch::kByte);
  std::ranges::copy(encoded.values(), bytes.data_ptr<std::uint8_t>());
  return bytes.permute({0, 3, 1, 2}).to(torch::kFloat32) / 255;
}

}  // namespace

Eigen::Matrix3f level_from_camera(double camera_elevation_rad) {
  // A camera that looks up sees what is level below its axis.
  return Eigen::AngleAxisf(static_cast<float>(camera_elevation_rad), Eigen::Vector3f::UnitX()).toRotationMatrix();
}

Eigen::Vector3d sun_of_shares(const Eigen::VectorXf& share) {
  if (share.size() != kSunBins) throw std::invalid_argument("sun_of_shares: there must be 160 shares");
  Eigen::Index peak = 0;
  share.maxCoeff(&peak);
  const auto row = [](Eigen::Index bin) { return static_cast<int>(bin) / kSunAzimuths; };
  const auto column = [](Eigen::Index bin) { return static_cast<int>(bin) % kSunAzimuths; };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int bin = 0; bin < kSunBins; ++bin) {
    const int across = std::abs(column(bin) - column(peak));
    if (std::abs(row(bin) - row(peak)) > 1 || std::min(across, kSunAzimuths - across) > 1) continue;
    sum += static_cast<double>(share[bin]) * sun_bin_direction(bin);
  }
  return sum.norm() > 0 ? sum.normalized() : sun_bin_direction(static_cast<int>(peak));
}

struct SkyRegressor::Impl {
  ModelInfo info;
  mutable SkyCnn net = nullptr;  // libtorch's forward() is not const; in evaluation nothing of it changes
};

SkyRegressor::SkyRegressor(const std::filesystem::path& weights, int threads) {
  const io::TensorFile file = io::read_safetensors(weights);
  impl_ = std::make_unique<Impl>();
  impl_->info = checked_sky_info(file, weights.string());
  impl_->net = SkyCnn(sky_cnn_options_from_json(impl_->info.options_json));
  load_weights(*impl_->net, file);
  impl_->net->eval();
  torch::set_num_threads(threads > 0 ? threads : default_thread_count());
}

SkyRegressor::SkyRegressor(SkyRegressor&&) noexcept = default;
SkyRegressor& SkyRegressor::operator=(SkyRegressor&&) noexcept = default;
SkyRegressor::~SkyRegressor() = default;

const ModelInfo& SkyRegressor::info() const { return impl_->info; }

SkyEstimate SkyRegressor::estimate(const Image& linear_crop) const {
  if (linear_crop.empty() || linear_crop.channels() != 3 || linear_crop.width() != linear_crop.height())
    throw std::invalid_argument("SkyRegressor: the crop must be square and of three channels");
  if (!std::ranges::all_of(linear_crop.values(), [](float value) { return std::isfinite(value); }))
    throw std::invalid_argument("SkyRegressor: a pixel of the crop is no number");
  const c10::InferenceMode inference;
  const SkyCnn& net = impl_->net;
  const SkyCnnImpl::Output out = impl_->net->forward(picture_of(linear_crop, net->options().px));
  const torch::Tensor share = out.sun.softmax(1).contiguous();
  const torch::Tensor numbers = net->restored(out.numbers).contiguous();
  const auto number = [&](SkyNumber which) {
    return static_cast<double>(numbers.data_ptr<float>()[static_cast<int>(which)]);
  };
  SkyEstimate estimate;
  estimate.sun_share = Eigen::Map<const Eigen::VectorXf>(share.data_ptr<float>(), kSunBins);
  const Eigen::Vector3d sun = sun_of_shares(estimate.sun_share);
  estimate.sky.sun_azimuth_deg = azimuth_deg(sun);
  estimate.sky.sun_elevation_deg = std::clamp(elevation_deg(sun), 0.0, 90.0);
  estimate.sky.turbidity =
      std::clamp(number(SkyNumber::kTurbidity), SkyParameters::kLeastTurbidity, SkyParameters::kMostTurbidity);
  estimate.sky.exposure = std::clamp(std::exp(number(SkyNumber::kLogExposure)), kLeastExposure, kMostExposure);
  const double sunlight = std::exp(number(SkyNumber::kLogSunlight)) - kLeastSunlight;
  estimate.sky.sun = std::clamp(sunlight / luminance_of(sun_irradiance(estimate.sky)), 0.0, SkyParameters::kMostSun);
  estimate.sky.ground_albedo = std::clamp(net->ground_albedo(), 0.0, 1.0);
  estimate.camera_elevation_rad = std::clamp(number(SkyNumber::kCameraElevation), -kPi / 2, kPi / 2);
  estimate.field_of_view_rad = std::clamp(number(SkyNumber::kFieldOfView), 0.0, kPi);
  return estimate;
}

Eigen::MatrixX3f SkyRegressor::light(const Image& linear_crop) const {
  const SkyEstimate found = estimate(linear_crop);
  return sky_radiance(found.sky, SphereGrid(kLightNside), level_from_camera(found.camera_elevation_rad));
}

}  // namespace faceprobe::net
