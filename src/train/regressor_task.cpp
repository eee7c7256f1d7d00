#include "train/regressor_task.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/net/light_regressor.h"

#include <cmath>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kFilterNside = 8;  // of the directions in which masks are compared

// First the lights as a mask, compared through cosine lobes that narrow from epoch to epoch: a lamp beside its place costs little while they
// are wide, and the nearer it comes the more. Then the same head learns how bright they are.
class GardnerTask : public RegressorTask {
 public:
  explicit GardnerTask(const RegressorConfig& config)
      : RegressorTask(config, points_of_panorama(config.light_size)), net_(options()),
        around_(points_of_grid(kFilterNside).direction), share_(points().solid_angle / points().solid_angle.sum()) {
    begin_epoch(0);
  }

  torch::nn::Module& net() override { return *net_; }
  const char* architecture() const override { return net::kGardnerArchitecture; }

  void start_at(const torch::Tensor& lights) override {
    const net::Panorama all = net::panorama_of(panoramas(lights));
    net_->start_at({all.colour.mean(0), mask_of(all).mean(0)});
  }

  void begin_epoch(double done) override {
    masks_ = done < config_.mask_share;
    if (masks_) filter_ = lobe_rows(around_, points(), std::pow(config_.largest_exponent, done / config_.mask_share));
  }

  torch::Tensor loss(const torch::Tensor& pictures, const torch::Tensor& lights) override {
    const net::Panorama truth = net::panorama_of(panoramas(lights));
    const net::Panorama found = net_->forward(pictures, config_.drop);
    const torch::Tensor colour = mean_square(found.colour - truth.colour);
    if (!masks_) return colour + config_.intensity_weight * mean_square(found.lights - truth.lights);
    const torch::Tensor off = (found.lights - mask_of(truth)).flatten(1);  // N x points
    return colour + config_.mask_weight * torch::matmul(off, filter_.t()).square().mean();
  }

  // Lights are scaled to be as bright as usual: halving, since brightness grows with the scale.
  void end_epoch(const torch::Tensor& pictures, const torch::Tensor& lights) override {
    if (masks_) return;
    const torch::NoGradGuard no_grad;
    const net::Panorama found = net_->forward(pictures);
    const double usual = balls().level(lights).log().mean().item<double>();
    constexpr int kHalvings = 12;
    double low = 1;
    double high = 6;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      const torch::Tensor light = as_points(net::panorama_radiance({found.colour, found.lights * middle}));
      (balls().level(light).log().mean().item<double>() < usual ? low : high) = middle;
    }
    net_->set_scale(low);
  }

  torch::Tensor radiance(const torch::Tensor& pictures) override { return as_points(net_->radiance(pictures)); }

 private:
  static torch::Tensor as_points(const torch::Tensor& panoramas) { return panoramas.flatten(2).transpose(1, 2); }

  torch::Tensor panoramas(const torch::Tensor& lights) const {
    return lights.transpose(1, 2).reshape({lights.size(0), 3, config_.light_size, 2 * config_.light_size});
  }

  static torch::Tensor mask_of(const net::Panorama& panorama) { return (panorama.lights > 0).to(torch::kFloat); }

  torch::Tensor mean_square(const torch::Tensor& off) const { return (off.square().flatten(2) * share_).sum(2).mean(); }

  net::GardnerNet net_;
  torch::Tensor around_, share_, filter_;
  bool masks_ = true;
};

class LegendreTask : public RegressorTask {
 public:
  explicit LegendreTask(const RegressorConfig& config)
      : RegressorTask(config, points_of_grid(config.light_size)), net_(options()) {}

  torch::nn::Module& net() override { return *net_; }
  const char* architecture() const override { return net::kLegendreArchitecture; }
  void start_at(const torch::Tensor& lights) override { net_->start_at(lights.log().mean(0)); }

  torch::Tensor loss(const torch::Tensor& pictures, const torch::Tensor& lights) override {
    return balls().loss(net_->forward(pictures, config_.drop).exp(), lights, config_);
  }

  torch::Tensor radiance(const torch::Tensor& pictures) override { return net_->forward(pictures).exp(); }

 private:
  net::LegendreNet net_;
};

template <class Task>
std::unique_ptr<RegressorTask> make_task(const RegressorConfig& config) {
  torch::manual_seed(config.seed);
  try {
    return std::make_unique<Task>(config);
  } catch (const std::invalid_argument& problem) {
    throw Error(ExitCode::kUsage, "The regressor config cannot be used: " + std::string(problem.what()));
  }
}

}  // namespace

net::LightCnnOptions RegressorTask::options() const {
  return {.picture_px = config_.picture_px,
          .widths = config_.widths,
          .features = config_.features,
          .light_size = config_.light_size};
}

std::unique_ptr<RegressorTask> gardner_task(const RegressorConfig& config) { return make_task<GardnerTask>(config); }

std::unique_ptr<RegressorTask> legendre_task(const RegressorConfig& config) { return make_task<LegendreTask>(config); }

}  // namespace faceprobe::train
