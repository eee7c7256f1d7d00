#include "cycles/comparison.h"

#include "cycles/compare.h"
#include "cycles/head.h"
#include "cycles/quadrature.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/random.h"

#include <algorithm>
#include <utility>

namespace faceprobe::bench {

namespace {

constexpr int kMarginPx = 2;
constexpr float kWhole = 0.999F;

Image mean_of(const Image& a, const Image& b) {
  Image out = a;
  for (std::size_t i = 0; i < out.values().size(); ++i) out.values()[i] = 0.5F * (a.values()[i] + b.values()[i]);
  return out;
}

// Values of a quadrature's columns for one map, put where their pixels are.
Image placed(const Eigen::MatrixXf& values, std::size_t map, const std::vector<int>& pixels, int size_px) {
  Image out(size_px, size_px, 3);
  const auto first = 3 * static_cast<Eigen::Index>(map);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      out(pixels[i] % size_px, pixels[i] / size_px, c) = values(static_cast<Eigen::Index>(i), first + c);
  }
  return out;
}

// reference * ours / theirs, pixel by pixel.
Image with_other_lobe(const Image& reference, const Image& ours, const Image& theirs) {
  Image out = reference;
  for (std::size_t i = 0; i < out.values().size(); ++i) {
    out.values()[i] *= theirs.values()[i] > 0 ? ours.values()[i] / theirs.values()[i] : 0.0F;
  }
  return out;
}

// The maps, then the lamp.
std::vector<MapComparison*> all_of(Comparison& comparison) {
  std::vector<MapComparison*> out;
  for (MapComparison& map : comparison.maps) out.push_back(&map);
  out.push_back(&comparison.lamp);
  return out;
}

MapComparison prepared(NamedMap map, const std::filesystem::path& file) {
  MapComparison out;
  out.light = synth::prepare_map(map.name, map.radiance, {});
  out.file = file;
  write_map_for_blender(file, map.radiance);
  out.map = std::move(map);
  return out;
}

void render_ours(Comparison& comparison, const ComparisonOptions& options) {
  std::vector<TurnedMap> turned;
  for (const MapComparison* map : all_of(comparison)) turned.push_back({&map->light, 0.0F});
  const FastView skin(comparison.head, comparison.camera, kLobeRoughness, kSkinF0, transport_options(options));
  const FastView metal(comparison.head, comparison.camera, kLobeRoughness, 1.0F, transport_options(options));
  std::vector<FastPicture> skin_pictures = skin.render(turned);
  std::vector<FastPicture> metal_pictures = metal.render(turned);
  for (std::size_t m = 0; m < turned.size(); ++m) {
    MapComparison& map = *all_of(comparison)[m];
    map.skin = std::move(skin_pictures[m]);
    map.metal = std::move(metal_pictures[m]);
    for (float& value : map.metal.glossy.values()) value *= 0.25F;
  }
  comparison.face = eroded_pixels(skin.fully_covered(kFaceVertices), kMarginPx);
}

void render_cycles(Comparison& comparison, const ComparisonOptions& options) {
  std::vector<CyclesRender> renders;
  for (const MapComparison* map : all_of(comparison)) {
    for (const int seed : {1, 2}) renders.push_back({map->file, std::max(1, options.samples / 2), seed, 0.0F});
  }
  const std::vector<CyclesPicture> pictures = render_with_cycles(comparison.cycles, renders);
  std::vector<int>& face = comparison.face;
  std::erase_if(face,
                [&](int pixel) { return pictures[0].coverage.values()[static_cast<std::size_t>(pixel)] < kWhole; });
  if (face.empty()) throw Error(ExitCode::kUnexpected, "The two renderers have no pixel of the face in common.");
  for (std::size_t m = 0; 2 * m < pictures.size(); ++m) {
    MapComparison& map = *all_of(comparison)[m];
    const CyclesPicture& a = pictures[2 * m];
    const CyclesPicture& b = pictures[2 * m + 1];
    map.cycles_diffuse = mean_of(a.diffuse, b.diffuse);
    map.cycles_glossy = mean_of(a.glossy, b.glossy);
    map.diffuse.noise = relative_rmse(a.diffuse, b.diffuse, face) / 2;
    map.glossy.noise = relative_rmse(a.glossy, b.glossy, face) / 2;
    map.diffuse.ours = relative_rmse(map.skin.diffuse, map.cycles_diffuse, face);
    map.glossy.ours = relative_rmse(map.metal.glossy, map.cycles_glossy, face);
  }
}

void sum_by_brute_force(Comparison& comparison, const ComparisonOptions& options) {
  Random random({2015, 7});
  std::vector<int> pixels;
  for (int i = 0; i < options.check_pixels; ++i) {
    pixels.push_back(comparison.face[static_cast<std::size_t>(random.below(static_cast<int>(comparison.face.size())))]);
  }
  std::vector<EnvMap> maps;
  for (const MapComparison* map : all_of(comparison)) maps.push_back(map->map.radiance);
  const Quadrature sums = integrate_pixels(comparison.cycles.mesh_cam, comparison.camera, pixels, maps,
                                           {.roughness = kLobeRoughness, .threads = options.threads});
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const auto sum = [&](Lobe lobe) {
      return placed(sums.radiance[static_cast<std::size_t>(lobe)], m, pixels, options.size_px);
    };
    MapComparison& map = *all_of(comparison)[m];
    map.diffuse.sum_cycles = relative_rmse(sum(Lobe::kDiffuse), map.cycles_diffuse, pixels);
    map.diffuse.ours_sum = relative_rmse(map.skin.diffuse, sum(Lobe::kDiffuse), pixels);
    map.glossy.sum_cycles = relative_rmse(sum(Lobe::kCycles), map.cycles_glossy, pixels);
    map.glossy.ours_sum = relative_rmse(map.skin.glossy, sum(Lobe::kSkin), pixels);
    map.glossy.own_lobe = relative_rmse(
        map.skin.glossy, with_other_lobe(map.cycles_glossy, sum(Lobe::kSkin), sum(Lobe::kCycles)), pixels);
  }
}

}  // namespace

synth::TransportOptions transport_options(const ComparisonOptions& options) {
  return {.nside = options.nside, .bounce_rays = 0, .threads = options.threads};
}

Comparison compare_with_cycles(const ComparisonOptions& options) {
  Comparison comparison;
  comparison.camera = head_camera(options.size_px);
  comparison.head = load_head(options.data);
  comparison.cycles = {options.blender,   options.folder, in_camera_frame(comparison.head, comparison.camera),
                       comparison.camera, kLobeRoughness, options.threads};
  std::filesystem::create_directories(options.folder);
  for (NamedMap& map : load_maps(options.data, options.maps)) {
    const std::filesystem::path file = options.folder / ("map_" + std::to_string(comparison.maps.size()) + ".exr");
    comparison.maps.push_back(prepared(std::move(map), file));
  }
  const int map_height = comparison.maps.front().map.radiance.height();
  comparison.lamp = prepared(red_lamp(map_height), options.folder / "map_lamp.exr");
  render_ours(comparison, options);
  render_cycles(comparison, options);
  sum_by_brute_force(comparison, options);
  return comparison;
}

}  // namespace faceprobe::bench
