#include "net/torch/widen.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/safetensors.h"
#include "faceprobe/net/model_file.h"
#include "net/model_info.h"
#include "net/torch/weights.h"

#include <algorithm>

namespace faceprobe::net {
namespace {

// Of each new channel the old one it copies, and one over the number of copies that old one has.
struct Copies {
  torch::Tensor source;  // int64
  torch::Tensor share;   // float
};

Copies copies_of(std::int64_t before, std::int64_t after) {
  std::vector<std::int64_t> source;
  std::vector<float> count(static_cast<std::size_t>(before), 0.0F);
  const bool grouped = after != before;
  const std::int64_t old_group = grouped ? before / kNormGroups : before;
  const std::int64_t new_group = grouped ? after / kNormGroups : after;
  for (std::int64_t c = 0; c < after; ++c) {
    source.push_back(c / new_group * old_group + c % new_group % old_group);
    ++count[static_cast<std::size_t>(source.back())];
  }
  std::vector<float> share;
  for (const std::int64_t from : source) share.push_back(1 / count[static_cast<std::size_t>(from)]);
  return {torch::tensor(source), torch::tensor(share)};
}

// The first layer's inputs are no features either: further ones begin without a say.
torch::Tensor with_more_inputs(const torch::Tensor& before, const torch::Tensor& like) {
  torch::Tensor all = torch::zeros({before.size(0), like.size(1), before.size(2), before.size(3)});
  all.narrow(1, 0, before.size(1)).copy_(before);
  return all;
}

torch::Tensor widened(const torch::Tensor& before, const torch::Tensor& like, double noise) {
  const Copies out = copies_of(before.size(0), like.size(0));
  torch::Tensor after = before.index_select(0, out.source);
  if (before.dim() < 4) return after;
  const Copies in = copies_of(before.size(1), like.size(1));
  after = after.index_select(1, in.source) * in.share.view({1, -1, 1, 1});
  if (noise == 0) return after;
  const torch::Tensor change = torch::randn_like(after) * (noise * after.std());
  return after + change * (out.share < 1).to(torch::kFloat).view({-1, 1, 1, 1});
}

// The head's outputs are no features: the first ones are the old network's, the others new.
torch::Tensor with_more_outputs(const torch::Tensor& before, const torch::Tensor& like) {
  torch::Tensor after = like.clone();
  torch::Tensor shared = before;
  if (before.dim() == 4) {
    const Copies in = copies_of(before.size(1), like.size(1));
    shared = before.index_select(1, in.source) * in.share.view({1, -1, 1, 1});
  }
  after.narrow(0, 0, before.size(0)).copy_(shared);
  return after;
}

void check_fits(const UNetOptions& narrow, const UNetOptions& wide) {
  bool fits = narrow.widths.size() == wide.widths.size() && narrow.convs_per_level == wide.convs_per_level &&
              narrow.in_channels <= wide.in_channels && narrow.out_channels <= wide.out_channels;
  for (std::size_t i = 0; fits && i < narrow.widths.size(); ++i) fits = narrow.widths[i] <= wide.widths[i];
  if (!fits) {
    throw Error(ExitCode::kModel, "The network to begin with is " + options_json(narrow) + ", the one to train " +
                                      options_json(wide) +
                                      "; it must have as many levels, and nowhere more channels than that.");
  }
}

}  // namespace

void load_widened(UNet& net, const std::filesystem::path& weights, double noise) {
  const io::TensorFile file = io::read_safetensors(weights);
  const UNetOptions options = unet_options_from_json(model_info(file, weights.string()).options_json);
  check_fits(options, net->options());
  UNet narrow(options);
  load_weights(*narrow, file);
  const torch::NoGradGuard no_grad;
  const auto before = narrow->named_parameters();
  for (const auto& item : net->named_parameters()) {
    const bool head = item.key().starts_with("head.");
    torch::Tensor old = before[item.key()];
    if (item.key() == "encoder.0.units.0.conv.weight") old = with_more_inputs(old, item.value());
    torch::Tensor(item.value()).copy_(head ? with_more_outputs(old, item.value()) : widened(old, item.value(), noise));
  }
}

}  // namespace faceprobe::net
