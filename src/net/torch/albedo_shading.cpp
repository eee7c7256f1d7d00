#include "net/torch/albedo_shading.h"

#include "net/option_reader.h"

#include <stdexcept>

namespace faceprobe::net {
namespace {

const AlbedoShadingOptions& valid(const AlbedoShadingOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  return options;
}

}  // namespace

std::string AlbedoShadingOptions::validate() const {
  if (std::string problem = MscrOptions{mean}.validate(); !problem.empty()) return problem;
  if (!(offset >= 1e-3F && offset <= 1)) return "offset is " + std::to_string(offset) + "; it must lie in 0.001 to 1.";
  if (divisor < 1 || divisor > kMostMscrDivisor || (divisor & (divisor - 1)) != 0)
    return "divisor is " + std::to_string(divisor) + "; it must be 1, 2, 4, 8 or 16.";
  return {};
}

std::string options_json(const AlbedoShadingOptions& options) {
  return nlohmann::json{{"mean", options.mean}, {"offset", options.offset}, {"divisor", options.divisor}}.dump();
}

AlbedoShadingOptions albedo_shading_options_from_json(const std::string& text) {
  OptionReader reader(text);
  const std::vector<float> mean = reader.numbers("mean");
  const float offset = reader.number("offset");
  const int divisor = reader.integer("divisor");
  reader.finish();
  require_valid_options(mean.size() == 3 ? "" : "mean has " + std::to_string(mean.size()) + " numbers; 3 are wanted.");
  const AlbedoShadingOptions options{{mean[0], mean[1], mean[2]}, offset, divisor};
  require_valid_options(options.validate());
  return options;
}

torch::Tensor albedo_shading_input(const torch::Tensor& diffuse, const AlbedoShadingOptions& options) {
  return mscr_input(diffuse, MscrOptions{options.mean});
}

torch::Tensor log_of_light(const torch::Tensor& light, const AlbedoShadingOptions& options) {
  return (light.clamp_min(0) + static_cast<double>(options.offset)).log();
}

torch::Tensor light_of_log(const torch::Tensor& log, const AlbedoShadingOptions& options) {
  constexpr double kMostLog = 20;  // whatever weights say, light stays finite
  return (log.clamp_max(kMostLog).exp() - static_cast<double>(options.offset)).clamp_min(0);
}

AlbedoShadingImpl::AlbedoShadingImpl(const AlbedoShadingOptions& options)
    : MscrTrunk(valid(options).divisor), options_(options) {
  albedo_ = add_branch("albedo", "albedo_up");
  shading_ = add_branch("shading", "shading_up");
}

LogLayers AlbedoShadingImpl::forward(const torch::Tensor& x) {
  const torch::Tensor seen = features(x);
  return {run(albedo_, seen), run(shading_, seen)};
}

}  // namespace faceprobe::net
