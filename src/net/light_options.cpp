#include "net/light_options.h"

#include "net/option_reader.h"

#include <algorithm>

namespace faceprobe::net {

std::string LightOptions::validate() const {
  constexpr int kMost = 16384;
  constexpr std::size_t kMostLayers = 8;
  const auto usable = [](int size) { return size >= 1 && size <= kMost; };
  if (!usable(inputs)) return "inputs is " + std::to_string(inputs) + "; it must lie in 1 to 16384.";
  if (!usable(outputs) || outputs % 3 != 0)
    return "outputs is " + std::to_string(outputs) + "; it must be a multiple of 3 in 3 to 16384.";
  if (hidden.empty() || hidden.size() > kMostLayers || !std::ranges::all_of(hidden, usable))
    return "hidden must list 1 to 8 sizes of 1 to 16384.";
  return {};
}

std::string options_json(const LightOptions& options) {
  return nlohmann::json({{"inputs", options.inputs}, {"hidden", options.hidden}, {"outputs", options.outputs}}).dump();
}

LightOptions light_options_from_json(const std::string& json) {
  OptionReader reader(json);
  LightOptions options;
  options.inputs = reader.integer("inputs");
  options.hidden = reader.integers("hidden");
  options.outputs = reader.integer("outputs");
  reader.finish();
  require_valid_options(options.validate());
  return options;
}

}  // namespace faceprobe::net
