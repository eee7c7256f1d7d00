#include "eval_stages.h"
#include "faceprobe/eval/shading_benchmark.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/net/face_net.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <memory>

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

}  // namespace

int eval_shading(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  std::vector<eval::ShadingMethod> methods = {eval::one_albedo_method()};
  for (const std::string& weights : options.weights) {
    const auto [name, file] = name_and_file(weights);
    const auto net = std::make_shared<net::FaceNet>(file, net::FaceNetOptions{.threads = options.threads});
    methods.push_back(by_region("one albedo a region, highlights of " + name, net));
    methods.push_back(network(name, net));
  }
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
