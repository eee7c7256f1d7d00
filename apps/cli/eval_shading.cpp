#include "eval_stages.h"
#include "faceprobe/eval/shading_benchmark.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/net/face_net.h"
#include "torch_side.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::cli {

namespace {

Image quotient(const Image& over, const Image& under) {
  Image out = over;
  for (std::size_t i = 0; i < out.values().size(); ++i) out.data()[i] /= std::max(1e-3F, under.data()[i]);
  return out;
}

Image difference(const Image& a, const Image& b) {
  Image out = a;
  for (std::size_t i = 0; i < out.values().size(); ++i) out.data()[i] -= b.data()[i];
  return out;
}

eval::ShadingMethod network(const std::string& name, const std::shared_ptr<net::FaceNet>& net) {
  return {name, [net](const eval::PhotoInput& input) {
            net::FaceLayers layers = net->layers_both_ways(input.linear, input.clip, input.mask, input.mesh_normal_cam);
            Image albedo = quotient(difference(input.linear, layers.highlight), layers.shading);
            return eval::ShadingEstimate{std::move(albedo), std::move(layers.shading)};
          }};
}

// lighting/albedo.h on the diffuse layer of the network: one colour a region. It is given the true regions.
eval::ShadingMethod by_region(const std::string& name, const std::shared_ptr<net::FaceNet>& net) {
  return {name, [net](const eval::PhotoInput& input) {
            const Image highlight =
                net->layers_both_ways(input.linear, input.clip, input.mask, input.mesh_normal_cam).highlight;
            const Image diffuse = difference(input.linear, highlight);
            ByteImage skin = input.region;
            std::replace_if(
                skin.values().begin(), skin.values().end(), [](std::uint8_t r) { return r > kSkinRegionCount; },
                std::uint8_t{0});
            const lighting::AlbedoModel model = lighting::fit_albedo(diffuse, skin, input.clip, input.mesh_normal_cam);
            Image albedo = lighting::albedo_picture(model, skin);
            Image shading = quotient(diffuse, albedo);
            return eval::ShadingEstimate{std::move(albedo), std::move(shading)};
          }};
}

eval::ShadingEstimate estimate_of(net::ShadingLayers layers) {
  return {std::move(layers.albedo), std::move(layers.shading)};
}

// The paper's way: highlights off first.
eval::ShadingMethod of_diffuse(const std::string& name, const PictureSplit& net,
                               const std::shared_ptr<net::FaceNet>& highlights) {
  return {name, [net, highlights](const eval::PhotoInput& input) {
            const net::FaceLayers seen =
                highlights->layers_both_ways(input.linear, input.clip, input.mask, input.mesh_normal_cam);
            return estimate_of(net.layers(difference(input.linear, seen.highlight)));
          }};
}

eval::ShadingMethod of_photo(const std::string& name, const PictureSplit& net) {
  return {name, [net](const eval::PhotoInput& input) { return estimate_of(net.layers(input.linear)); }};
}

// Rows of networks that split a picture, and the face network whose highlights come off for those that want a diffuse layer: the first that is
// named, else the program's.
class Rows {
 public:
  explicit Rows(const EvalOptions& options) : threads_(options.threads), device_(options.device) {
    refuse_missing_device(device_);
    for (const std::string& weights : options.weights) add(weights);
    for (const auto& [name, net] : diffuse_) {
      if (!face_.second) load_face("net", io::data_file("face.safetensors").string());
      methods_.push_back(of_diffuse(name + ", highlights of " + face_.first, net, face_.second));
    }
  }

  const std::vector<eval::ShadingMethod>& methods() const { return methods_; }

 private:
  void add(const std::string& weights) {
    const auto [name, file] = name_and_file(weights);
    const std::string architecture = net::read_model_info(file).architecture;
    if (architecture == net::kAlbedoShadingArchitecture || architecture == net::kShiArchitecture) {
      const TorchSide& torch = torch_side();
      const PictureSplit net = torch.shading_net(file, {.threads = threads_, .device = torch.device_from_name(device_)});
      if (net.takes_diffuse) {
        diffuse_.emplace_back(name, net);
      } else {
        methods_.push_back(of_photo(name, net));
      }
      return;
    }
    const auto net = load_face(name, file);
    methods_.push_back(by_region("one albedo a region, highlights of " + name, net));
    methods_.push_back(network(name, net));
  }

  std::shared_ptr<net::FaceNet> load_face(const std::string& name, const std::string& file) {
    auto net = std::make_shared<net::FaceNet>(file, net::FaceNetOptions{.threads = threads_});
    if (!face_.second) face_ = {name, net};
    return net;
  }

  int threads_;
  std::string device_;
  std::vector<eval::ShadingMethod> methods_ = {eval::one_albedo_method()};
  std::pair<std::string, std::shared_ptr<net::FaceNet>> face_;
  std::vector<std::pair<std::string, PictureSplit>> diffuse_;
};

}  // namespace

int eval_shading(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  const std::vector<eval::ShadingMethod> methods = Rows(options).methods();
  const eval::ScoreTable table =
      eval::measure_shading(faces, methods, {.samples = options.samples, .progress = eval_progress()});
  fmt::print("{} photos of {}.\n", table.rows().size() / std::max<std::size_t>(1, methods.size()), options.data);
  fmt::print("\n### Shading, error after the best scale over the shading itself\n\n{}", table.markdown("shading", 3));
  fmt::print("\n### Albedo, the same\n\n{}", table.markdown("albedo", 3));
  fmt::print("\n### Colour of the light in the shading, degrees\n\n{}", table.markdown("light_colour", 2));
  fmt::print("\n### The same by skin tone\n\n{}", table.markdown_by_group("light_colour", "tone", 2));
  fmt::print("\n### Shading by skin tone\n\n{}", table.markdown_by_group("shading", "tone", 3));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "shading.csv", table.csv());
  io::write_file_atomically(folder / "shading.json", table.json());
  return 0;
}

}  // namespace faceprobe::cli
