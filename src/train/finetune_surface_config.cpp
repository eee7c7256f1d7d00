#include "faceprobe/train/finetune_surface.h"

#include <initializer_list>
#include <sstream>

namespace faceprobe::train {
namespace {

// The first fault of some numbers and their ranges; empty when there is none.
struct Range {
  const char* name;
  double value, least, most;
};
std::string first_fault(std::initializer_list<Range> ranges) {
  for (const Range& range : ranges) {
    if (range.value >= range.least && range.value <= range.most) continue;
    std::ostringstream text;
    text << range.name << " is " << range.value << "; allowed is " << range.least << " to " << range.most << '.';
    return text.str();
  }
  return {};
}

}  // namespace

std::string RerenderOptions::validate() const {
  return first_fault({{"order", static_cast<double>(order), 1, 8},
                      {"ridge", ridge, 1e-9, 1},
                      {"albedo_weight", albedo_weight, 0, 100},
                      {"guard_weight", guard_weight, 0, 100},
                      {"normal_slack_deg", normal_slack_deg, 0.1, 90},
                      {"contrast_slack", contrast_slack, 0.01, 1},
                      {"confidence_slack", confidence_slack, 0, 0.9},
                      {"curl_slack", curl_slack, 0.01, 10}});
}

std::string FinetuneSurfaceConfig::validate() const {
  const std::string fault = first_fault({{"steps", static_cast<double>(steps), 1, 1e6},
                                         {"photos", static_cast<double>(photos), 2, 64},
                                         {"synthetic_batch", static_cast<double>(synthetic_batch), 0, 4096},
                                         {"learning_rate", learning_rate, 1e-9, 1},
                                         {"weight", weight, 0, 1000},
                                         {"largest_gradient", largest_gradient, 1e-6, 1e6},
                                         {"held_out_share", held_out_share, 0.001, 0.999}});
  return fault.empty() ? rerender.validate() : fault;
}

}  // namespace faceprobe::train
