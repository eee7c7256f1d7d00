#include "faceprobe/eval/relight_benchmark.h"

#include "eval/map_metrics.h"
#include "eval/photo_choice.h"
#include "eval/relight_sheet.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/eval/light_metrics.h"
#include "faceprobe/eval/sun_metrics.h"

#include <cmath>
#include <optional>
#include <utility>

namespace faceprobe::eval {
namespace {

std::map<std::string, double> all_metrics(const Eigen::MatrixX3f& truth, const Eigen::MatrixX3f& found,
                                          const LitObject& object, const SphereGrid& grid, bool one_lamp,
                                          const std::optional<Sun>& sun) {
  std::map<std::string, double> metrics = map_metrics(truth, found, object, grid, one_lamp);
  if (sun) {
    const SunError off = sun_error(*sun, says_light(found, grid) ? sun_of(found, grid) : std::nullopt);
    metrics["sun_centroid"] = off.angle_deg;
    metrics["sun_azimuth"] = off.azimuth_deg;
    metrics["sun_elevation"] = off.elevation_deg;
  }
  return metrics;
}

}  // namespace

LightMethod ambient_method(int nside) {
  const int cells = SphereGrid(nside).cell_count();
  return {"ambient", [cells](const LightInput&) { return Eigen::MatrixX3f(Eigen::MatrixX3f::Ones(cells, 3)); }};
}

LightMethod harmonics_method(int order, int nside) {
  const SphereGrid grid(nside);
  Eigen::MatrixXd basis(grid.cell_count(), sh::coefficient_count(order));
  for (int j = 0; j < grid.cell_count(); ++j)
    basis.row(j) = sh::basis(order, grid.direction(j).cast<double>()).transpose();
  return {"truth in harmonics of order " + std::to_string(order),
          [basis, order](const LightInput& input) -> Eigen::MatrixX3f {
            return (basis * sh::project(input.sample.environment, order)).cwiseMax(0.0).cast<float>();
          }};
}

LightMethod constant_method(const std::string& name, Eigen::MatrixX3f light) {
  return {name, [light = std::move(light)](const LightInput&) { return light; }};
}

Eigen::MatrixX3f mean_light(const synth::ShardReader& faces, int samples, int nside) {
  const SphereGrid grid(nside);
  Eigen::MatrixX3f mean = Eigen::MatrixX3f::Zero(grid.cell_count(), 3);
  for (const int number : evenly_chosen(faces, samples)) {
    const Eigen::MatrixX3f light = grid_from_env_map(faces.copy_sample(number).environment, grid);
    if (const float level = light.mean(); level > 0) mean += light / level;
  }
  return mean;
}

std::string RelightBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  if (rows < 0 || rows > 200) return "rows is " + std::to_string(rows) + "; allowed is 0 to 200.";
  if (nside < 2 || nside > 32) return "nside is " + std::to_string(nside) + "; allowed is 2 to 32.";
  return {};
}

RelightScores measure_relighting(const synth::ShardReader& faces, const std::vector<LightMethod>& methods,
                                 const LitObject& object, const RelightBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const SphereGrid grid(options.nside);
  RelightScores scores;
  scores.table.order_labels("tone", tone_names());
  scores.table.order_labels("turn", turn_names());
  scores.table.order_labels("clipped", clipped_names());
  scores.table.order_labels("size", size_names());
  RelightSheet sheet(object, grid, options.rows, static_cast<int>(methods.size()));
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  int visited = 0;
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    if (!photo.sample.lamps.empty()) return;  // a group's room: no one map lights it
    const Eigen::MatrixX3f truth = grid_from_env_map(photo.sample.environment, grid);
    const bool one_lamp = has_dominant_light(truth, grid);
    const std::optional<Sun> sun = one_lamp ? sun_of(truth, grid) : std::nullopt;
    std::map<std::string, std::string> groups = {{"tone", photo.tone()},
                                                 {"turn", photo.turn()},
                                                 {"clipped", photo.clipped()},
                                                 {"size", photo.size()},
                                                 {"light", one_lamp ? "one lamp" : "several or soft"}};
    if (options.scene) groups["scene"] = options.scene(photo.sample.map);
    const bool drawn = sheet.takes(visited++, static_cast<int>(numbers.size()));
    if (drawn) sheet.begin_row(photo.sample.photo, truth);
    const PhotoInput input = photo.input();
    for (const LightMethod& method : methods) {
      const Eigen::MatrixX3f found = method.light({number, input, photo.sample, photo.view});
      scores.table.add({method.name, std::to_string(number), groups,
                        all_metrics(truth, found, object, grid, one_lamp, sun), photo.person});
      if (drawn) sheet.add(found);
    }
  });
  scores.picture = sheet.picture();
  return scores;
}

}  // namespace faceprobe::eval
