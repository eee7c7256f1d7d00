#include "highlight_methods.h"

#include "eval_stages.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/highlight/skin_subspace.h"
#include "faceprobe/net/face_net.h"
#include "torch_side.h"

#include <memory>

namespace faceprobe::cli {

namespace {

eval::HighlightMethod classical(highlight::Separator separator, int threads) {
  return {std::string(highlight::separator_name(separator)), [separator, threads](const eval::PhotoInput& input) {
            return highlight::separate(input.linear, input.mask, {.separator = separator, .threads = threads}).highlight;
          }};
}

}  // namespace

std::vector<eval::HighlightMethod> classical_highlight_methods(int threads) {
  std::vector<eval::HighlightMethod> methods = {eval::black_method()};
  for (const highlight::Separator separator :
       {highlight::Separator::kTan, highlight::Separator::kYang, highlight::Separator::kShen})
    methods.push_back(classical(separator, threads));
  methods.push_back({"li 2017, lite", [threads](const eval::PhotoInput& input) {
                       return highlight::separate_skin(input.linear, input.clip, input.mask, input.mesh_normal_cam,
                                                       {.threads = threads})
                           .highlight;
                     }});
  return methods;
}

eval::HighlightMethod network_highlight_method(const std::string& named, const std::string& device, int threads) {
  const auto [name, file] = name_and_file(named);
  // Both ways, as estimate does.
  if (net::read_model_info(file).architecture == net::kFaceArchitecture) {
    auto face = std::make_shared<net::FaceNet>(file, net::FaceNetOptions{.threads = threads});
    return {name, [face](const eval::PhotoInput& input) {
              return face->layers_both_ways(input.linear, input.clip, input.mask, input.mesh_normal_cam).highlight;
            }};
  }
  const TorchSide& torch = torch_side();
  const HighlightLayer net = torch.highlight_net(file, {.threads = threads, .device = torch.device_from_name(device)});
  return {name, [net](const eval::PhotoInput& input) { return net(input.linear, input.clip, input.mask); }};
}

}  // namespace faceprobe::cli
