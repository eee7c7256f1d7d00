#include "train/model.h"

#include "faceprobe/core/error.h"
#include "faceprobe/net/model_file.h"

#include "net/face_outputs.h"
#include "net/head.h"
#include "net/torch/albedo_shading.h"
#include "net/torch/highlight_head.h"
#include "net/torch/mscr.h"
#include "net/torch/shi.h"
#include "net/torch/unet.h"
#include "train/albedo_shading_loss.h"
#include "train/autocast.h"
#include "train/channels_last.h"
#include "train/face_loss.h"
#include "train/loss.h"
#include "train/shi_loss.h"

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

torch::Tensor highlight_of(const torch::Tensor& raw, const Batch& batch) {
  return net::highlight_from_raw(raw.to(torch::kFloat), batch.linear);
}

using Forward = std::function<torch::Tensor(const torch::Tensor&)>;

// What is measured is measured in float, as the weights will be used.
Forward in_precision(const std::string& precision, Forward forward) {
  if (precision != "bf16") return forward;
  return [forward = std::move(forward)](const torch::Tensor& input) {
    if (!torch::GradMode::is_enabled()) return forward(input);
    const Bf16Products bf16;
    return forward(input).to(torch::kFloat);
  };
}

struct Raw {
  torch::Tensor highlight;
  torch::Tensor surface, gain;  // of the face network alone; the gain is the picture's
};

// `surface`: with the inputs and outputs of the face network.
Model unet_model(const TrainConfig& config, bool surface) {
  net::UNetOptions defaults;
  if (surface) {
    defaults.in_channels = net::FaceInputs::kCount;
    defaults.out_channels = net::FaceOutputs::kCount;
  }
  const auto options = read_options(net::unet_options_from_json, merged(net::options_json(defaults), config.network));
  net::UNet unet(options);
  unet->to(torch::kFloat, false);
  const Forward run = in_precision(config.precision, [impl = unet.ptr()](const auto& x) { return impl->forward(x); });
  const auto raw_of = [run, surface](const Batch& batch) -> Raw {
    if (!surface) return {run(net::prepare_input(batch.linear, batch.clip, batch.mask)), {}, {}};
    const net::FaceInput input = net::prepare_face_input(batch.linear, batch.clip, batch.mask, batch.surface.mesh);
    const net::FaceRaw raw = net::split_face_raw(run(input.channels));
    return {raw.highlight, raw.surface, input.gain};
  };
  Model model;
  model.module = unet.ptr();
  model.forward = [raw_of](const Batch& batch) { return highlight_of(raw_of(batch).highlight, batch); };
  model.highlight = model.forward;
  model.metadata = {{net::kArchitectureKey, surface ? net::kFaceArchitecture : net::kUNetArchitecture},
                    {net::kOptionsKey, net::options_json(options)}};
  model.loss = [raw_of, surface](const Batch& batch, const LossConfig& weights) {
    const Raw raw = raw_of(batch);
    const torch::Tensor loss = highlight_loss(highlight_of(raw.highlight, batch), batch, weights);
    if (!surface) return loss;
    return loss + surface_loss(net::surface_from_raw(raw.surface, raw.gain), batch.surface, weights);
  };
  if (surface) {
    model.surface = [raw_of](const Batch& batch) {
      const Raw raw = raw_of(batch);
      return net::surface_from_raw(raw.surface, raw.gain);
    };
  }
  return model;
}

Model mscr_model(const TrainConfig& config) {
  const auto options =
      read_options(net::mscr_options_from_json, merged(net::options_json(net::MscrOptions{}), config.network));
  net::Mscr mscr(options);
  const Forward run = in_precision(config.precision, [impl = mscr.ptr()](const auto& x) { return impl->forward(x); });
  auto forward = [run, options](const Batch& batch) { return run(net::mscr_input(batch.linear, options)); };
  Model model;
  model.module = mscr.ptr();
  model.forward = forward;
  model.highlight = [forward](const Batch& batch) { return torch::minimum(forward(batch).clamp_min(0), batch.linear); };
  model.loss = [forward](const Batch& batch, const LossConfig&) { return squared_loss(forward(batch), batch); };
  model.metadata = {{net::kArchitectureKey, net::kMscrArchitecture}, {net::kOptionsKey, net::options_json(options)}};
  return model;
}

// Given what the true highlights leave of the picture.
Model albedo_shading_model(const TrainConfig& config) {
  const auto options = read_options(net::albedo_shading_options_from_json,
                                    merged(net::options_json(net::AlbedoShadingOptions{}), config.network));
  net::AlbedoShading network(options);
  const Forward run = in_precision(config.precision, [impl = network.ptr()](const auto& x) {
    const net::LogLayers logs = impl->forward(x);
    return torch::cat({logs.albedo, logs.shading}, 1);
  });
  auto forward = [run, options](const Batch& batch) {
    return run(net::albedo_shading_input(batch.linear - batch.highlight, options));
  };
  const auto logs_of = [forward](const Batch& batch) {
    const std::vector<torch::Tensor> logs = forward(batch).chunk(2, 1);
    return net::LogLayers{logs[0], logs[1]};
  };
  Model model;
  model.module = network.ptr();
  model.forward = forward;
  model.loss = [logs_of, options](const Batch& batch, const LossConfig&) {
    return albedo_shading_loss(logs_of(batch), batch, options);
  };
  model.layers = [logs_of, options](const Batch& batch) {
    const net::LogLayers logs = logs_of(batch);
    return FoundLayers{net::light_of_log(logs.albedo, options), net::light_of_log(logs.shading, options)};
  };
  model.metadata = {{net::kArchitectureKey, net::kAlbedoShadingArchitecture},
                    {net::kOptionsKey, net::options_json(options)}};
  return model;
}

Model shi_model(const std::string& given) {
  const auto options = read_options(net::shi_options_from_json, merged(net::options_json(net::ShiOptions{}), given));
  net::Shi shi(options);
  auto layers = [shi](const Batch& batch) mutable { return shi->forward(net::shi_input(batch.linear)); };
  Model model;
  model.module = shi.ptr();
  model.forward = [layers](const Batch& batch) mutable { return layers(batch).highlight; };
  model.highlight = [layers](const Batch& batch) mutable {
    return torch::minimum(layers(batch).highlight.clamp_min(0), batch.linear);
  };
  model.loss = [layers](const Batch& batch, const LossConfig&) mutable { return shi_loss(layers(batch), batch); };
  model.metadata = {{net::kArchitectureKey, net::kShiArchitecture}, {net::kOptionsKey, net::options_json(options)}};
  return model;
}

}  // namespace

bool finds_surface(const TrainConfig& config) { return config.architecture == net::kFaceArchitecture; }

namespace {

Model model_as_drawn(const TrainConfig& config) {
  if (config.architecture == net::kMscrArchitecture) return mscr_model(config);
  if (config.architecture == net::kShiArchitecture) return shi_model(config.network);
  if (config.architecture == net::kAlbedoShadingArchitecture) return albedo_shading_model(config);
  Model model = unet_model(config, finds_surface(config));
  if (const auto unet = std::dynamic_pointer_cast<net::UNetImpl>(model.module);
      config.picture_px % unet->multiple() != 0) {
    throw Error(ExitCode::kUsage, "The training config's picture_px is " + std::to_string(config.picture_px) +
                                      "; this network takes multiples of " + std::to_string(unet->multiple()) + ".");
  }
  if (config.picture_px > 0) model.metadata[net::kPictureKey] = std::to_string(config.picture_px);
  return model;
}

}  // namespace

Model make_model(const TrainConfig& config) {
  Model model = model_as_drawn(config);
  to_channels_last(*model.module);
  return model;
}

}  // namespace faceprobe::train
