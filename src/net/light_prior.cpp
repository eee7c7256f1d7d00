#include "faceprobe/net/light_prior.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/safetensors.h"
#include "io/safetensors_header.h"
#include "net/light_options.h"
#include "net/model_info.h"
#include "net/weight_list.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace faceprobe::net {
namespace {

using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

struct Dense {
  RowMatrix weight;
  Eigen::VectorXf bias;
};

Eigen::VectorXf vector(WeightList& list, const std::string& name, int size) {
  const std::vector<float> values = list.take(name, {size});
  return Eigen::Map<const Eigen::VectorXf>(values.data(), size);
}

Dense dense(WeightList& list, const std::string& name, int in, int out) {
  const std::vector<float> weight = list.take(name + ".weight", {out, in});
  return {Eigen::Map<const RowMatrix>(weight.data(), out, in), vector(list, name + ".bias", out)};
}

}  // namespace

struct LightPrior::Impl {
  LightOptions options;
  ModelInfo info;
  Eigen::VectorXf mean, scale;  // of the inputs
  std::vector<Dense> layers;
};

LightPrior::LightPrior(const std::filesystem::path& weights) {
  const io::TensorFile file = io::read_safetensors(weights);
  ModelInfo info = model_info(file, weights.string());
  if (info.architecture != kLightArchitecture) {
    throw Error(ExitCode::kModel, "The weights are of a network " + io::quoted(info.architecture) +
                                      "; what light to expect is told by light. Use weights made for it.");
  }
  LightOptions options = light_options_from_json(info.options_json);
  WeightList list(file);
  auto impl = std::make_unique<Impl>();
  impl->mean = vector(list, "mean", options.inputs);
  impl->scale = vector(list, "scale", options.inputs);
  int in = options.inputs;
  for (std::size_t i = 0; i <= options.hidden.size(); ++i) {
    const int out = i < options.hidden.size() ? options.hidden[i] : options.outputs;
    impl->layers.push_back(dense(list, "layers." + std::to_string(i), in, out));
    in = out;
  }
  list.finish();
  impl->options = std::move(options);
  impl->info = std::move(info);
  impl_ = std::move(impl);
}

LightPrior::LightPrior(LightPrior&&) noexcept = default;
LightPrior& LightPrior::operator=(LightPrior&&) noexcept = default;
LightPrior::~LightPrior() = default;

int LightPrior::inputs() const { return impl_->options.inputs; }
const ModelInfo& LightPrior::info() const { return impl_->info; }

Eigen::MatrixX3f LightPrior::radiance(const Eigen::VectorXf& features) const {
  if (features.size() != impl_->options.inputs) {
    throw std::invalid_argument("LightPrior: there must be " + std::to_string(impl_->options.inputs) +
                                " features, not " + std::to_string(features.size()));
  }
  Eigen::VectorXf x = (features - impl_->mean).cwiseProduct(impl_->scale);
  for (std::size_t i = 0; i < impl_->layers.size(); ++i) {
    const Dense& layer = impl_->layers[i];
    const Eigen::VectorXf sum = layer.weight * x + layer.bias;
    x = i + 1 < impl_->layers.size() ? Eigen::VectorXf(sum.cwiseMax(LightOptions::kSlope * sum)) : sum;
  }
  const Eigen::VectorXf light = x.cwiseMax(-LightOptions::kLargestLog).cwiseMin(LightOptions::kLargestLog).array().exp();
  return Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>(light.data(), light.size() / 3, 3);
}

}  // namespace faceprobe::net
