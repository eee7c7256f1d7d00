// bench_one_lamp --data DIR [--people N]: what better normals are worth. Synthetic faces under one lamp each, whose normals and lamp are known, are
// estimated with normals that are known, of the face mesh, of a head model fitted to the landmarks, and of the network; all else is the same.
// Prints one Markdown table: how far the normals are off, and beside it how far the lamp is, degrees.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/region.h"
#include "faceprobe/eval/sun_metrics.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/largest_face.h"
#include "faceprobe/pipeline/observe.h"
#include "faceprobe/synth/generate.h"
#include "one_head.h"
#include "paper/direction_setting.h"
#include "paper/light_direction.h"
#include "support/statistics.h"
#include "synth_assets.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace faceprobe;
using pipeline::NormalSource;

constexpr double kWidestDeg = 80;  // of lamps from the camera's axis: beyond, most of a face is dark

struct Options {
  std::string data;
  int people = 20;
  int threads = 0;
};

// A disc of two degrees' radius, as strong on a surface that faces it as a sky of radiance 1, in a surround of a twentieth of that. Each photo turns its
// map about the vertical by an angle of its own, so only the height is given.
synth::MapLight lamp_map(double elevation_deg) {
  constexpr int kHeight = 256;
  const double radius_rad = radians(2);
  const auto radiance = static_cast<float>(1 / (radius_rad * radius_rad));  // pi of irradiance over pi r^2
  const Eigen::Vector3f towards = direction_from_angles(0, elevation_deg).cast<float>();
  EnvMap map(Image(2 * kHeight, kHeight, 3, 0.05F));
  const auto cosine = static_cast<float>(std::cos(radius_rad));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < 2 * kHeight; ++x) {
      if (map.direction(x, y).dot(towards) < cosine) continue;
      for (int c = 0; c < 3; ++c) map.radiance()(x, y, c) = radiance;
    }
  }
  return synth::prepare_map("lamp at " + std::to_string(static_cast<int>(elevation_deg)), map, {});
}

// The known normals in the face's crop, unit; 0 off the person.
Image known_normals(const synth::ViewLayers& view, const face::Crop& crop) {
  Image normals = face::crop_picture(view.normal, crop);
  for (std::size_t i = 0; i < normals.pixel_count(); ++i) {
    Eigen::Map<Eigen::Vector3f> normal(normals.data() + 3 * i);
    if (normal.norm() > 0.5F) {
      normal.normalize();
    } else {
      normal.setZero();
    }
  }
  return normals;
}

bool shows_skin(const synth::ViewLayers& view, const face::Crop& crop, int x, int y) {
  const Eigen::Vector2d at = crop.photo_from_crop(x + 0.5, y + 0.5);
  const int column = static_cast<int>(std::floor(at.x()));
  const int row = static_cast<int>(std::floor(at.y()));
  if (column < 0 || row < 0 || column >= view.region.width() || row >= view.region.height()) return false;
  const std::uint8_t region = view.region(column, row);
  return region >= 1 && region <= kSkinRegionCount;
}

// Mean over the skin that the face's normals cover.
double normals_off_deg(const face::FaceGeometry& geometry, const Image& known, const synth::ViewLayers& view) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < known.height(); ++y) {
    for (int x = 0; x < known.width(); ++x) {
      const Eigen::Vector3f truth(known.pixel(x, y));
      const Eigen::Vector3f found(geometry.normal_cam.pixel(x, y));
      if (truth.isZero() || found.isZero() || !shows_skin(view, geometry.crop, x, y)) continue;
      sum += angle_between_deg(truth.cast<double>(), found.cast<double>());
      ++count;
    }
  }
  return sum / count;  // NaN without any
}

// What one row says of one photo: degrees.
struct Errors {
  double normals = 0, single_lamp = 0, without_prior = 0, whole = 0;
  bool complete() const { return std::isfinite(normals + single_lamp + without_prior + whole); }
};

double off_deg(const std::optional<Eigen::Vector3d>& found, const Eigen::Vector3d& lamp) {
  return found ? angle_between_deg(*found, lamp) : std::nan("");
}

std::optional<Eigen::Vector3d> main_light(const lighting::Light& light) {
  const std::vector<Eigen::Vector3d> lights = cli::light_directions(cli::result_of(light.radiance, light.confidence));
  return lights.empty() ? std::nullopt : std::optional(lights.front());
}

Errors errors_of(const pipeline::Estimator& estimator, const pipeline::FaceEstimate& face,
                 const face::FaceGeometry& geometry, const lighting::Observations& seen, const synth::ViewLayers& view,
                 const Eigen::Vector3d& lamp) {
  const Image known = known_normals(view, geometry.crop);
  return {normals_off_deg(geometry, known, view), off_deg(cli::single_lamp(seen), lamp),
          off_deg(main_light(estimator.light_of(seen, false)), lamp),
          off_deg(main_light(estimator.light_of(seen, face.enough_shown)), lamp)};
}

// The network's estimate with the known normals in the place of its own.
Errors with_known_normals(const pipeline::Estimator& estimator, const pipeline::FaceEstimate& face,
                          const synth::ViewLayers& view, const Eigen::Vector3d& lamp) {
  constexpr float kExactRad = 0.01F;
  face::FaceGeometry geometry = face.geometry;
  geometry.normal_cam = known_normals(view, geometry.crop);
  geometry.normal_error_rad = Image(geometry.crop.width, geometry.crop.height, 1, kExactRad);
  const pipeline::EstimateOptions& options = estimator.options();
  const lighting::Observations seen = pipeline::observe(geometry, face.layers.highlight, face.shading, face.clipped,
                                                        options.max_patches, options.threads);
  if (seen.count() == 0) return {std::nan(""), 0, 0, 0};
  return errors_of(estimator, face, geometry, seen, view, lamp);
}

void print(const std::string& name, const std::vector<Errors>& rows) {
  const auto column = [&](double Errors::*value) {
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Errors& row : rows) values.push_back(row.*value);
    return values;
  };
  std::printf("| %s | %s |", name.c_str(), bench::cell(bench::mean(column(&Errors::normals))).c_str());
  for (double Errors::*value : {&Errors::single_lamp, &Errors::without_prior, &Errors::whole}) {
    const std::vector<double> values = column(value);
    std::printf(" %s | %s |", bench::cell(bench::mean(values)).c_str(), bench::cell(bench::median(values)).c_str());
  }
  std::printf("\n");
}

int run(const Options& options) {
  const std::filesystem::path data = options.data;
  const std::filesystem::path skins = data / "faces" / "london_uv_textures";
  const std::string head = (data / "faces" / "ict_facekit").string();
  synth::Assets assets =
      cli::load_synth_assets({.packed = {},
                              .heads = {head},
                              .skins = std::filesystem::is_directory(skins) ? skins.string() : std::string(),
                              .maps = {},
                              .reflectance = {},
                              .mixed_maps = {},
                              .threads = options.threads});
  assets.maps.clear();
  for (const double elevation_deg : {-15.0, 0.0, 15.0, 30.0, 45.0, 60.0})
    assets.maps.push_back(lamp_map(elevation_deg));
  synth::Recipe recipe;
  recipe.size_px = 256;
  recipe.split = synth::Split::kDev;  // people and skins that no network was trained on
  recipe.seed = 31;
  recipe.views_per_person = 2;
  recipe.samples_per_view = 8;
  recipe.skins_per_person = 1;
  recipe.environment_height = 64;
  recipe.count = options.people * recipe.samples_per_person();

  pipeline::EstimateOptions base;
  base.finder.min_face_px = face::kSmallFacePx;
  base.threads = options.threads;
  base.surface_fit = cli::surface_of_head(head, options.threads);
  std::vector<pipeline::Estimator> estimators;  // the last is whose normals are replaced by the known ones
  std::vector<std::string> names;
  for (const NormalSource source : {NormalSource::kMesh, NormalSource::kFit, NormalSource::kNet}) {
    cli::DirectionSetting setting = cli::normals_setting(source, base);
    names.push_back(setting.name);
    estimators.emplace_back(std::move(setting.options));
  }
  std::vector<std::vector<Errors>> rows(names.size() + 1);
  int lit = 0;
  for (int person = 0; person < options.people; ++person) {
    for (const synth::ViewSamples& shot : synth::generate_person(assets, recipe, person, options.threads)) {
      for (const synth::Sample& sample : shot.samples) {
        const std::optional<eval::Sun> lamp = eval::sun_of(sample.environment);
        if (!lamp || angle_between_deg(lamp->direction, Eigen::Vector3d::UnitZ()) > kWidestDeg) continue;
        ++lit;
        const io::Photo photo = io::photo_from_srgb(sample.photo);
        std::vector<Errors> found;
        for (const pipeline::Estimator& estimator : estimators) {
          const std::optional<pipeline::FaceEstimate> face = pipeline::find_largest_face(estimator, photo);
          if (!face) break;
          found.push_back(errors_of(estimator, *face, face->geometry, face->observations, shot.view, lamp->direction));
          if (found.size() == estimators.size())
            found.push_back(with_known_normals(estimator, *face, shot.view, lamp->direction));
        }
        bool complete = found.size() == rows.size();
        for (const Errors& errors : found) complete = complete && errors.complete();
        for (std::size_t k = 0; complete && k < rows.size(); ++k) rows[k].push_back(found[k]);
      }
    }
  }
  std::printf(
      "Degrees; %zu photos, of the %d of %d people with the lamp up to %.0f degrees off the camera's axis, to which "
      "all rows have an answer. Layers are the network's in every row. The fitted head model is the one that the heads "
      "were made of, which no real head is. The single lamp is a least-squares fit to the shading and knows of no "
      "shadows; the solver has no learnt prior, then that of an estimate as it comes, which learnt from the network's "
      "normals.\n\n",
      rows.front().size(), lit, options.people, kWidestDeg);
  std::printf(
      "| normals | off by | single lamp: mean | median | solver without the prior: mean | median | whole estimate: "
      "mean "
      "| median |\n|---|---:|---:|---:|---:|---:|---:|---:|\n");
  for (std::size_t k = 0; k < names.size(); ++k) print(names[k], rows[k]);
  print("normals known", rows.back());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What better normals are worth: synthetic faces under one lamp");
  Options options;
  app.add_option("--data", options.data, "data folder (docs/data.md)")->required();
  app.add_option("--people", options.people, "heads to light, 16 photos each")
      ->capture_default_str()
      ->check(CLI::Range(1, 10000));
  app.add_option("--threads", options.threads, "threads; 0 = all processors")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return run(options);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
