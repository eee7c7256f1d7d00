#include "train/model.h"

#include "faceprobe/core/error.h"
#include "faceprobe/net/model_file.h"

#include "net/torch/highlight_head.h"
#include "net/torch/mscr.h"
#include "net/torch/unet.h"

#include <nlohmann/json.hpp>

namespace faceprobe::train {
namespace {

// What is given replaces the default, the rest stays.
std::string merged(const std::string& defaults, const std::string& given) {
  nlohmann::json options = nlohmann::json::parse(defaults);
  options.update(nlohmann::json::parse(given));
  return options.dump();
}

template <class Read>
auto read_options(const Read& read, const std::string& text) {
  try {
    return read(text);
  } catch (const Error& error) {
    throw Error(ExitCode::kUsage, std::string("The training config's network: ") + error.what());
  }
}

Model unet_model(const std::string& given) {
  const auto options = read_options(net::unet_options_from_json, merged(net::options_json(net::UNetOptions{}), given));
  net::UNet unet(options);
  unet->to(torch::kFloat, false);
  const auto forward = [unet](const Batch& batch) mutable {
    const torch::Tensor raw = unet->forward(net::prepare_input(batch.linear, batch.clip, batch.mask));
    return net::highlight_from_raw(raw.to(torch::kFloat), batch.linear);
  };
  return {unet.ptr(),
          forward,
          forward,
          {{net::kArchitectureKey, net::kUNetArchitecture}, {net::kOptionsKey, net::options_json(options)}}};
}

Model mscr_model(const std::string& given) {
  const auto options = read_options(net::mscr_options_from_json, merged(net::options_json(net::MscrOptions{}), given));
  net::Mscr mscr(options);
  auto forward = [mscr, options](const Batch& batch) mutable {
    return mscr->forward(net::mscr_input(batch.linear, options));
  };
  auto bounded = [forward](const Batch& batch) mutable {
    return torch::minimum(forward(batch).clamp_min(0), batch.linear);
  };
  return {mscr.ptr(),
          forward,
          bounded,
          {{net::kArchitectureKey, net::kMscrArchitecture}, {net::kOptionsKey, net::options_json(options)}}};
}

}  // namespace

Model make_model(const TrainConfig& config) {
  return config.architecture == "mscr" ? mscr_model(config.network) : unet_model(config.network);
}

}  // namespace faceprobe::train
