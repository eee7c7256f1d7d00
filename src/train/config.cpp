#include "faceprobe/train/config.h"

#include "train/config_fields.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace faceprobe::train {
namespace {

using Json = nlohmann::ordered_json;

// The network's options: an object, which the config keeps as text.
template <class Text>
struct ObjectText {
  Text& text;
};
template <class Text>
ObjectText(Text&) -> ObjectText<Text>;

void from_json(const Json& json, const ObjectText<std::string>& object) {
  json.get_ref<const Json::object_t&>();  // throws what nlohmann throws for a value of another type
  object.text = json.dump();
}
void to_json(Json& json, const ObjectText<const std::string>& object) { json = Json::parse(object.text); }

constexpr auto kEachTrainField = [](auto& config, const auto& visit) {
  visit("architecture", config.architecture);
  visit("picture_px", config.picture_px, 0, 1024);
  visit("precision", config.precision);
  visit("batch", config.batch, 1, 4096);
  visit("steps", config.steps, 1, 1e9);
  visit("learning_rate", config.learning_rate, 1e-9, 1);
  visit("weight_decay", config.weight_decay, 0, 1);
  visit("warm_up", config.warm_up, 0, 1e9);
  visit("final_share", config.final_share, 0, 1);
  visit("average_decay", config.average_decay, 0, 0.999999);
  visit("largest_gradient", config.largest_gradient, 1e-6, 1e6);
  visit("seed", config.seed);
  visit("validate_every", config.validate_every, 1, 1e9);
  visit("validation_samples", config.validation_samples, 1, 1e6);
  visit("save_every", config.save_every, 1, 1e9);
  visit("mirror", config.augment.mirror);
  visit("colour_deviation", config.augment.colour_deviation, 0, 1);
  visit("exposure_deviation", config.augment.exposure_deviation, 0, 2);
  visit("grey_share", config.augment.grey_share, 0, 1);
  visit("no_mask_share", config.augment.no_mask_share, 0, 1);
  visit("occluder_share", config.augment.occluder_share, 0, 1);
  visit("backdrop_share", config.augment.backdrop_share, 0, 1);
  visit("zoom_share", config.augment.zoom_share, 0, 1);
  visit("close_share", config.augment.close_share, 0, 1);
  visit("cut_share", config.augment.cut_share, 0, 1);
  visit("loss_encoded", config.loss.encoded, 0, 100);
  visit("loss_gradient", config.loss.gradient, 0, 100);
  visit("loss_rms", config.loss.rms, 0, 100);
  visit("loss_similarity", config.loss.similarity, 0, 100);
  visit("loss_elsewhere", config.loss.elsewhere, 0, 1);
  visit("loss_normal", config.loss.normal, 0, 100);
  visit("loss_spread", config.loss.spread, 0, 100);
  visit("loss_depth", config.loss.depth, 0, 100);
  visit("loss_region", config.loss.region, 0, 100);
  visit("loss_rare", config.loss.rare, 0, 100);
  visit("loss_shading", config.loss.shading, 0, 100);
  visit("loss_colour", config.loss.colour, 0, 100);
  visit("loss_open", config.loss.open, 0, 100);
  visit("network", ObjectText{config.network});
};

}  // namespace

std::string TrainConfig::validate() const {
  std::string problem = limits_problem("training", *this, kEachTrainField);
  if (!problem.empty()) return problem;
  constexpr std::array<std::string_view, 5> kArchitectures = {"unet", "face", "mscr", "shi", "albedo_shading"};
  if (std::ranges::find(kArchitectures, std::string_view(architecture)) == kArchitectures.end()) {
    return "The training config's architecture is \"" + architecture +
           "\"; there are unet, face, mscr, shi and albedo_shading.";
  }
  if (precision != "float32" && precision != "bf16") {
    return "The training config's precision is \"" + precision + "\"; there are float32 and bf16.";
  }
  if (precision == "bf16" && architecture == "shi") {
    return "The training config's precision is bf16 for the architecture \"shi\"; allowed is float32, and bf16 for the "
           "others.";
  }
  if (picture_px != 0 && (picture_px < 8 || architecture != "face")) {
    return "The training config's picture_px is " + std::to_string(picture_px) + " for the architecture \"" +
           architecture + "\"; allowed is 0, and for face 8 to 1024.";
  }
  return {};
}

TrainConfig train_config_from_json(const std::string& text) {
  return fields_from_json("training", text, TrainConfig(), kEachTrainField);
}

std::string to_json(const TrainConfig& config) { return fields_to_json(config, kEachTrainField); }

}  // namespace faceprobe::train
