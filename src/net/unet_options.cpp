#include "net/unet_options.h"

#include "net/option_reader.h"

namespace faceprobe::net {
namespace {

// Generous for what we train, and small enough that options from a file cannot ask for more memory than there is.
constexpr int kMaxChannels = 64, kMaxWidth = 512, kMaxLevels = 6, kMaxConvs = 4;

std::string out_of_range(const std::string& name, int value, int most) {
  return name + " is " + std::to_string(value) + "; it must lie in 1 to " + std::to_string(most) + ".";
}

}  // namespace

std::string UNetOptions::validate() const {
  if (in_channels < 1 || in_channels > kMaxChannels) return out_of_range("in_channels", in_channels, kMaxChannels);
  if (out_channels < 1 || out_channels > kMaxChannels) return out_of_range("out_channels", out_channels, kMaxChannels);
  if (widths.empty() || widths.size() > kMaxLevels) {
    return out_of_range("The number of widths", static_cast<int>(widths.size()), kMaxLevels);
  }
  for (const int width : widths) {
    if (width < kNormGroups || width > kMaxWidth || width % kNormGroups != 0) {
      return "A width is " + std::to_string(width) + "; each must be a multiple of " + std::to_string(kNormGroups) +
             " up to " + std::to_string(kMaxWidth) + ".";
    }
  }
  if (convs_per_level < 1 || convs_per_level > kMaxConvs) {
    return out_of_range("convs_per_level", convs_per_level, kMaxConvs);
  }
  return {};
}

std::string options_json(const UNetOptions& options) {
  return nlohmann::json{{"in_channels", options.in_channels},
                        {"out_channels", options.out_channels},
                        {"widths", options.widths},
                        {"convs_per_level", options.convs_per_level}}
      .dump();
}

UNetOptions unet_options_from_json(const std::string& text) {
  OptionReader reader(text);
  UNetOptions options;
  options.in_channels = reader.integer("in_channels");
  options.out_channels = reader.integer("out_channels");
  options.widths = reader.integers("widths");
  options.convs_per_level = reader.integer("convs_per_level");
  reader.finish();
  require_valid_options(options.validate());
  return options;
}

}  // namespace faceprobe::net
