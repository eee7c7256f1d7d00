#include "faceprobe/eval/insert_benchmark.h"

#include "eval/nan.h"
#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/insert/insert.h"
#include "faceprobe/insert/spot.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::eval {
namespace {

// Where the thing stands: shares of the picture and of the face's depth.
constexpr double kAcross = 0.6;
constexpr double kDown = 0.9;
constexpr float kNearer = 0.75F;
constexpr float kSize = 0.55F;      // of its longer side, of the picture's width
constexpr float kChanged = 0.004F;  // least change of linear light that counts as such

float face_depth_m(const SyntheticPhoto& photo) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < photo.skin.pixel_count(); ++i) {
    if (photo.skin.data()[i] == 0) continue;
    sum += photo.view.depth_m.data()[i];
    ++count;
  }
  return static_cast<float>(sum / count);
}

// All but the light.
insert::Scene scene_of(const SyntheticPhoto& photo, const render::Model& model) {
  const synth::ViewLayers& seen = photo.view;
  insert::Scene scene;
  scene.view = {seen.focal_px, seen.centre_px.x(), seen.centre_px.y(), photo.layers.linear.width(),
                photo.layers.linear.height()};
  scene.model = model;
  const float depth_m = kNearer * face_depth_m(photo);
  const Eigen::Vector3f size = model.box().sizes();
  const float width_m = kSize * depth_m * static_cast<float>(scene.view.width_px / scene.view.focal_px);
  render::place(scene.model, {.height_m = width_m * size.y() / std::max(size.x(), size.y()),
                              .foot_m = insert::point_at(scene.view, kAcross * scene.view.width_px,
                                                         kDown * scene.view.height_px, depth_m)});
  return scene;
}

double squared(double x) { return x * x; }

// Mean squares of sRGB differences over some pixels, and how many there were.
struct Squares {
  double sum = 0;
  double count = 0;

  void add(const float* a, const float* b) {
    for (int c = 0; c < 3; ++c)
      sum += squared(255.0 * static_cast<double>(srgb_from_linear(std::clamp(a[c], 0.0F, 1.0F)) -
                                                 srgb_from_linear(std::clamp(b[c], 0.0F, 1.0F))));
    count += 3;
  }
  double rms() const { return count > 0 ? std::sqrt(sum / count) : kNaN; }
};

// Errors of the picture over what the true one changes of the photo, with the thing's light times an exposure.
struct Errors {
  double whole, shadow;
};
Errors errors_of(const Image& photo, const insert::Insertion& truth, const insert::Insertion& found, float exposure) {
  Squares whole;
  Squares shadow;
  for (int y = 0; y < truth.box.height(); ++y) {
    for (int x = 0; x < truth.box.width(); ++x) {
      const float* before = photo.pixel(truth.box.left + x, truth.box.top + y);
      const float* there = truth.picture.pixel(truth.box.left + x, truth.box.top + y);
      const float* here = found.picture.pixel(truth.box.left + x, truth.box.top + y);
      const bool changed =
          std::abs(there[0] - before[0]) + std::abs(there[1] - before[1]) + std::abs(there[2] - before[2]) >
          3 * kChanged;
      if (!changed) continue;
      float exposed[3];
      for (int c = 0; c < 3; ++c) exposed[c] = here[c] + (exposure - 1) * found.layers.object(x, y, c);
      whole.add(there, exposed);
      if (truth.layers.object(x, y, 3) == 0) shadow.add(there, here);
    }
  }
  return {whole.rms(), shadow.rms()};
}

std::map<std::string, double> metrics_of(const Image& photo, const insert::Insertion& truth,
                                         const insert::Insertion& found) {
  const Errors as_it_is = errors_of(photo, truth, found, 1);
  double scaled = as_it_is.whole;
  for (int eighth_stop = -16; eighth_stop <= 16; ++eighth_stop)
    scaled = std::min(scaled, errors_of(photo, truth, found, std::exp2(static_cast<float>(eighth_stop) / 8)).whole);
  return {{"rmse", as_it_is.whole}, {"scaled", scaled}, {"shadow", as_it_is.shadow}};
}

void append_row(ByteImage& sheet, const std::vector<ByteImage>& cells) {
  const int width = cells[0].width();
  const int height = cells[0].height();
  ByteImage row(width * static_cast<int>(cells.size()), height, 3);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (int y = 0; y < std::min(height, cells[i].height()); ++y)
      std::copy_n(cells[i].pixel(0, y), 3 * std::min(width, cells[i].width()),
                  row.pixel(static_cast<int>(i) * width, y));
  }
  ByteImage longer(row.width(), sheet.height() + height, 3);
  std::copy(sheet.values().begin(), sheet.values().end(), longer.values().begin());
  std::copy(row.values().begin(), row.values().end(),
            longer.values().begin() + static_cast<std::ptrdiff_t>(sheet.values().size()));
  sheet = std::move(longer);
}

}  // namespace

std::string InsertBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  if (rays < 1 || rays > 1 << 20) return "rays is " + std::to_string(rays) + "; allowed is 1 to 1048576.";
  if (rows < 0 || rows > 200) return "rows is " + std::to_string(rows) + "; allowed is 0 to 200.";
  if (nside < 2 || nside > 32) return "nside is " + std::to_string(nside) + "; allowed is 2 to 32.";
  return {};
}

InsertScores measure_insertion(const synth::ShardReader& faces, const std::vector<LightMethod>& methods,
                               const render::Model& model, const InsertBenchmark& options) {
  for (const std::string& problem : {options.validate(), model.validate()}) {
    if (!problem.empty()) throw Error(ExitCode::kUsage, problem);
  }
  const SphereGrid grid(options.nside);
  insert::Options how;
  how.match_blur = how.match_grain = false;
  how.render = {.samples = options.rays, .least_samples = options.rays, .threads = options.threads};
  InsertScores scores;
  scores.table.order_labels("tone", tone_names());
  int drawn = 0;
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    if (!photo.sample.lamps.empty()) return;  // a group's room: no one map lights it
    const Image& linear = photo.layers.linear;
    insert::Scene scene = scene_of(photo, model);
    scene.environment = photo.sample.environment;
    const insert::Insertion truth = insert::insert_model(linear, scene, how);
    std::vector<ByteImage> cells = {photo.sample.photo, encode_srgb(truth.picture)};
    const PhotoInput input = photo.input();
    for (const LightMethod& method : methods) {
      const Eigen::MatrixX3f light = method.light({number, input, photo.sample, photo.view});
      const bool there = light.rows() == grid.cell_count() && light.allFinite() && light.maxCoeff() > 0;
      std::map<std::string, double> metrics = {{"rmse", kNaN}, {"scaled", kNaN}, {"shadow", kNaN}};
      cells.emplace_back();
      if (there) {
        scene.environment = env_map_from_grid(light, grid, 128, 64);
        const insert::Insertion found = insert::insert_model(linear, scene, how);
        metrics = metrics_of(linear, truth, found);
        cells.back() = encode_srgb(found.picture);
      }
      scores.table.add({method.name, std::to_string(number), {{"tone", photo.tone()}}, metrics, photo.person});
    }
    if (drawn++ < options.rows) append_row(scores.picture, cells);
  });
  return scores;
}

}  // namespace faceprobe::eval
