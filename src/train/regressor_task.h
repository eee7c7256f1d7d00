#pragma once
// Internal: what sets the training of the two rivals apart: the network, its loss, and how its output is light.

#include "faceprobe/train/train_regressor.h"
#include "net/torch/light_cnn.h"
#include "train/regressor_loss.h"

#include <memory>

namespace faceprobe::train {

class RegressorTask {
 public:
  RegressorTask(const RegressorConfig& config, LightPoints points) : config_(config), points_(std::move(points)) {}
  virtual ~RegressorTask() = default;
  RegressorTask(const RegressorTask&) = delete;
  RegressorTask& operator=(const RegressorTask&) = delete;

  virtual torch::nn::Module& net() = 0;
  virtual const char* architecture() const = 0;
  // The network begins with what is usual in these lights, N x points x 3.
  virtual void start_at(const torch::Tensor& lights) = 0;
  // done: 0 to 1, the share of the epochs that are over.
  virtual void begin_epoch(double /*done*/) {}
  // Pictures N x 3 x px x px, sRGB 0 .. 1; lights N x points x 3.
  virtual torch::Tensor loss(const torch::Tensor& pictures, const torch::Tensor& lights) = 0;
  // After an epoch, with some of the training data.
  virtual void end_epoch(const torch::Tensor& /*pictures*/, const torch::Tensor& /*lights*/) {}
  virtual torch::Tensor radiance(const torch::Tensor& pictures) = 0;  // N x points x 3, > 0

  const LightPoints& points() const { return points_; }
  const BallPictures& balls() const { return balls_; }
  std::string options_json() const { return net::options_json(options()); }

 protected:
  net::LightCnnOptions options() const;
  RegressorConfig config_;

 private:
  LightPoints points_;
  BallPictures balls_{points_};
};

// Throw Error(kUsage): options that the network does not take.
std::unique_ptr<RegressorTask> gardner_task(const RegressorConfig& config);
std::unique_ptr<RegressorTask> legendre_task(const RegressorConfig& config);

}  // namespace faceprobe::train
