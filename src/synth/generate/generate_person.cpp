#include "faceprobe/core/angles.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/compose.h"
#include "faceprobe/synth/generate.h"
#include "synth/generate/group.h"
#include "synth/generate/light_sample_draw.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <span>

namespace faceprobe::synth {
namespace {

class Stopwatch {
 public:
  // Adds the time since the last call to `total`.
  void lap(double& total) {
    const auto now = std::chrono::steady_clock::now();
    total += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

Eigen::Matrix3f map_turn(float yaw) { return Eigen::AngleAxisf(yaw, Eigen::Vector3f::UnitY()).toRotationMatrix(); }

struct FaceMean {
  Eigen::Vector3f radiance;  // of the skin
  Eigen::Vector3f light;     // mean shading: the light's colour
};

FaceMean face_mean(const Fragments& fragments, const ViewSurface& surface, const Eigen::MatrixX3f& shading,
                   const Eigen::MatrixX3f& specular) {
  Eigen::Vector3d radiance = Eigen::Vector3d::Zero();
  Eigen::Vector3d light = Eigen::Vector3d::Zero();
  double weight = 0;
  for (int i = 0; i < fragments.count(); ++i) {
    if (fragments.material[static_cast<std::size_t>(i)] != Material::kSkin) continue;
    const double share = static_cast<double>(fragments.coverage[static_cast<std::size_t>(i)]);
    const Eigen::RowVector3f sent =
        surface.albedo.row(i).cwiseProduct(shading.row(i)) + surface.specular_albedo(i) * specular.row(i);
    radiance += share * sent.cast<double>().transpose();
    light += share * shading.row(i).cast<double>().transpose();
    weight += share;
  }
  if (weight <= 0) return {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  return {(radiance / weight).cast<float>(), (light / weight).cast<float>()};
}

std::string settings_json(const Assets& assets, const SampleDraw& draw, const SkinSettings& skin,
                          const Eigen::Vector3f& gain) {
  const auto triple = [](const Eigen::Vector3f& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  const nlohmann::ordered_json json = {
      {"map", assets.maps[static_cast<std::size_t>(draw.map)].name},
      {"skin", draw.skin},
      {"texture", skin.texture >= 0 ? assets.skins[static_cast<std::size_t>(skin.texture)].name : ""},
      {"tone", triple(skin.target_tone)},
      {"specular_albedo", skin.specular_albedo},
      {"roughness", skin.roughness},
      {"gain", triple(gain)},
      {"jpeg_quality", draw.sensor.jpeg_quality},
      {"grey", draw.sensor.grey},
  };
  return json.dump();
}

std::vector<Figure> figures_of(std::span<const Person> people) {
  std::vector<Figure> figures;
  for (const Person& person : people) figures.insert(figures.end(), person.figures.begin(), person.figures.end());
  return figures;
}

// What dims a map to the level that was drawn for a room with lamps.
float map_gain_of(const SampleDraw& draw, const MapLight& map) {
  if (draw.map_level <= 0) return 1.0F;
  // Of an even sky as bright as the map's mean.
  const float irradiance = static_cast<float>(kPi) * map.mean_radiance.mean();
  return irradiance > 0 ? draw.map_level / irradiance : 1.0F;
}

}  // namespace

std::vector<ViewSamples> generate_person(const Assets& assets, const Recipe& recipe, int person_number, int threads,
                                         GenerateTimes* times) {
  GenerateTimes unused;
  GenerateTimes& spent = times != nullptr ? *times : unused;
  Stopwatch watch;
  const std::vector<Person> people = draw_people(assets, recipe, person_number);
  const Scene scene(figures_of(people));
  std::vector<View> views;
  std::vector<Fragments> seen;
  for (int v = 0; v < recipe.views_per_person; ++v) {
    views.push_back(draw_scene_view(people, recipe, person_number, v));
    seen.push_back(
        find_fragments(scene, views.back().camera, {.samples_per_side = recipe.samples_per_side, .threads = threads}));
  }
  watch.lap(spent.scene);

  const TransportOptions transport_options{.nside = recipe.nside, .bounce_rays = recipe.bounce_rays, .threads = threads};
  std::vector<const Fragments*> all_seen;
  all_seen.reserve(seen.size());
  for (const Fragments& fragments : seen) all_seen.push_back(&fragments);
  const SceneTransport transport = build_scene_transport(scene, vertices_seen(all_seen), transport_options);
  const SphereGrid grid(recipe.nside);
  watch.lap(spent.transport);

  std::vector<ViewSamples> result;
  for (int v = 0; v < recipe.views_per_person; ++v) {
    const View& view = views[static_cast<std::size_t>(v)];
    const Eigen::Isometry3f& pose = view.camera.camera_from_scene;
    Fragments fragments = std::move(seen[static_cast<std::size_t>(v)]);
    ViewSamples out;
    out.view = view_layers(people, view, fragments);
    FragmentSurface lobes = plain_lobes(fragments);
    for (const Person& person : people) add_person_lobes(person, fragments, view.camera, lobes);
    const ViewTransport view_transport = build_view_transport(scene, transport, std::move(fragments), std::move(lobes),
                                                              pose.inverse().translation(), transport_options);
    watch.lap(spent.transport);

    const auto count = static_cast<std::size_t>(recipe.samples_per_view);
    const Random view_random({recipe.seed, static_cast<std::uint64_t>(recipe.split),
                              static_cast<std::uint64_t>(person_number), 0x5A3D, static_cast<std::uint64_t>(v)});
    std::vector<SampleDraw> draws(count);
    std::vector<LightSample> lights(count);
    std::vector<Eigen::Matrix3f> camera_from_map(count);
    std::vector<float> map_gain(count);
    parallel_for(recipe.samples_per_view, threads, [&](int first, int last) {
      for (int s = first; s < last; ++s) {
        const auto k = static_cast<std::size_t>(s);
        Random random = view_random.split(static_cast<std::uint64_t>(s));
        draws[k] = draw_sample(assets, recipe, random, s);
        camera_from_map[k] = view.camera_from_level * map_turn(draws[k].map_yaw);
        const MapLight& map = assets.maps[static_cast<std::size_t>(draws[k].map)];
        map_gain[k] = map_gain_of(draws[k], map);
        lights[k] = light_from_map(map, pose.linear().transpose() * camera_from_map[k],
                                   Eigen::Vector3f::Constant(map_gain[k]), grid);
        if (recipe.multi_face) {
          Random lamp_random = view_random.split(static_cast<std::uint64_t>(s)).split(2);
          lights[k].near = draw_lamps(people, view.camera, recipe, lamp_random);
        }
      }
    });
    watch.lap(spent.shade);

    std::vector<ViewSurface> surfaces;
    for (std::size_t k = 0; k < people.front().skins.size(); ++k) {
      surfaces.push_back(empty_surface(transport, view_transport.fragments));
      for (const Person& person : people) {
        add_person_surface(assets, person, person.skins[k], scene, transport, view_transport.fragments, surfaces.back());
      }
    }
    out.samples.resize(count);
    watch.lap(spent.compose);
    // A product of this many maps is as fast as it gets, and its results still fit into memory whatever the number of maps.
    constexpr int kMapsAtOnce = 64;
    std::vector<FragmentLight> lit;
    int begin = 0;
    const auto compose = [&](int first, int last) {
      for (int s = begin + first; s < begin + last; ++s) {
        const auto k = static_cast<std::size_t>(s);
        const FragmentLight& light = lit[static_cast<std::size_t>(s - begin)];
        const SampleDraw& draw = draws[k];
        const SkinSettings& skin = people.front().skins[static_cast<std::size_t>(draw.skin)];
        const ViewSurface& surface = surfaces[static_cast<std::size_t>(draw.skin)];
        const MapLight& map = assets.maps[static_cast<std::size_t>(draw.map)];
        Eigen::MatrixX3f shading = light.shading;
        if (recipe.bounce_rays > 0)
          shading += bounced_shading(transport, view_transport, light.vertex_shading, surface.row_albedo);
        if (recipe.mode == Mode::kDefault) scatter_below_surface(view_transport.fragments, view.camera, shading);
        const FaceMean mean = face_mean(view_transport.fragments, surface, shading, light.specular);
        const Eigen::Vector3f gain = exposure_gain(draw, mean.radiance, mean.light, skin.target_tone);
        const Eigen::Vector3f distant_gain = map_gain[k] * gain;
        const Image background = recipe.mode == Mode::kPaper ? Image(recipe.size_px, recipe.size_px, 3)
                                                             : draw_background(map, view.camera, camera_from_map[k],
                                                                               distant_gain, draw.background_blur_px);
        LinearLayers layers =
            gather_layers(view_transport.fragments, surface, shading, light.specular, background, gain);
        Image radiance = layers.diffuse;
        for (std::size_t i = 0; i < radiance.values().size(); ++i) radiance.data()[i] += layers.highlight.data()[i];
        Random camera_random = view_random.split(static_cast<std::uint64_t>(s)).split(1);
        SensorPicture picture = take_picture(radiance, draw.sensor, camera_random);

        Sample& sample = out.samples[k];
        sample.photo = std::move(picture.photo);
        sample.clip = std::move(picture.clip);
        sample.highlight = std::move(layers.highlight);
        sample.diffuse = std::move(layers.diffuse);
        sample.albedo = std::move(layers.albedo);
        sample.shading = std::move(layers.shading);
        sample.environment = map_in_frame(map, camera_from_map[k], distant_gain, 2 * recipe.environment_height,
                                          recipe.environment_height);
        for (NearLight lamp : lights[k].near) {
          lamp.position = pose * lamp.position;
          lamp.radiance = lamp.radiance.cwiseProduct(gain);
          sample.lamps.push_back(lamp);
        }
        sample.map = draw.map;
        sample.map_yaw = draw.map_yaw;
        sample.settings_json = settings_json(assets, draw, skin, gain);
      }
    };
    for (; begin < recipe.samples_per_view; begin += kMapsAtOnce) {
      const int maps = std::min(kMapsAtOnce, recipe.samples_per_view - begin);
      const auto chunk = std::span(lights).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(maps));
      lit = shade(scene, transport, view_transport, chunk, {.threads = threads});
      watch.lap(spent.shade);
      parallel_for(maps, threads, compose);
      watch.lap(spent.compose);
    }
    result.push_back(std::move(out));
  }
  return result;
}

}  // namespace faceprobe::synth
