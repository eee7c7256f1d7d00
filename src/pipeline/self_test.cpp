#include "faceprobe/pipeline/self_test.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/lighting/transport.h"
#include "faceprobe/pipeline/estimate.h"
#include "faceprobe/render/path_tracer.h"
#include "faceprobe/render/shapes.h"
#include "pipeline/model_card.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

namespace faceprobe::pipeline {
namespace {

// Runs a check that says what it found, or throws.
Check checked(const std::string& name, const std::function<std::string()>& body) {
  try {
    return {name, true, body(), ExitCode::kOk};
  } catch (const Error& error) {
    return {name, false, error.what(), error.code()};
  } catch (const std::exception& error) {
    return {name, false, error.what(), ExitCode::kUnexpected};
  }
}

[[noreturn]] void fail(const std::string& sentence) { throw Error(ExitCode::kUnexpected, sentence); }

std::string model_file(const char* name) {
  const std::filesystem::path path = io::data_file(name);
  if (const std::string problem = card_mismatch(path); !problem.empty()) throw Error(ExitCode::kModel, problem);
  return path.string() + ", " + std::to_string(std::filesystem::file_size(path) / 1024) + " KiB";
}

// The half of a ball that the camera sees, as a face without features would be seen.
lighting::Observations half_ball() {
  const SphereGrid grid(8);
  std::vector<int> seen;
  for (int i = 0; i < grid.cell_count(); ++i) {
    if (grid.direction(i).z() > 0.05F) seen.push_back(i);
  }
  lighting::Observations ball;
  ball.resize(static_cast<Eigen::Index>(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i)
    ball.normal.row(static_cast<Eigen::Index>(i)) = grid.directions().row(seen[i]);
  ball.view.rowwise() = Eigen::RowVector3f::UnitZ();
  return ball;
}

std::string known_light() {
  constexpr double kMostDeg = 8;  // two cells of the grid
  const SphereGrid grid(16);
  const Eigen::Vector3d towards = direction_from_angles(35, 25);
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  light.row(grid.cell_of(towards.cast<float>())).setConstant(200);
  lighting::Observations ball = half_ball();
  const lighting::Transport transport = lighting::build_transport(ball, grid);
  ball.highlight = transport.highlight() * light;
  ball.shading = transport.diffuse() * light;
  const lighting::Light found = lighting::solve(ball, {});
  Eigen::Index brightest = 0;
  found.radiance.rowwise().sum().maxCoeff(&brightest);
  const double off = angle_between_deg(towards, grid.direction(static_cast<int>(brightest)).cast<double>());
  std::string text = "a known lamp came back " + std::to_string(off).substr(0, 4) + " degrees off";
  if (!(off <= kMostDeg))
    fail(text + ", " + std::to_string(static_cast<int>(kMostDeg)) + " are allowed; please report it.");
  return text;
}

std::string furnace() {
  constexpr float kMostError = 0.02F;  // noise of 64 samples
  render::Model ball = render::sphere();
  ball.materials = {{.name = "white", .kind = render::MaterialKind::kPlastic, .colour = Eigen::Vector3f::Ones()}};
  for (render::TriangleMesh& mesh : ball.meshes) mesh.material = 0;
  render::place(ball, {.height_m = 0.3F, .foot_m = {0, -0.15F, -1}});
  EnvMap even(16, 8);
  std::fill(even.radiance().values().begin(), even.radiance().values().end(), 1.0F);
  const render::Layers layers =
      render::PathTracer(std::move(ball), even, {.view = {80, 16, 16, 32, 32}}).render({.samples = 64});
  const float light = layers.object(16, 16, 1);
  std::string text = "a white ball in an even light of 1 shows " + std::to_string(light).substr(0, 5);
  if (!(std::abs(light - 1) <= kMostError)) fail(text + "; please report it.");
  return text;
}

std::string readable_photos() {
  const std::vector<std::string> formats = io::photo_formats();
  std::string text;
  for (const std::string& format : formats) text += (text.empty() ? "" : ", ") + format;
  for (const char* needed : {"jpeg", "png", "exr"}) {
    if (std::ranges::count(formats, needed) == 0)
      fail("only " + text + " can be read, and not " + needed + ": OpenImageIO is not built as Debian's is.");
  }
  return text;
}

}  // namespace

std::vector<Check> self_test() {
  std::vector<Check> checks;
  for (const char* name : {"face_detection_short_range.tflite", "face_detection_full_range.tflite",
                           "face_landmark.tflite", "canonical-face-model.obj", "face.safetensors", "light.safetensors"})
    checks.push_back(checked(name, [name] { return model_file(name); }));
  checks.push_back(checked("models load", [] {
    const Estimator estimator;
    return std::string("detector, face mesh, face network and light prior");
  }));
  checks.push_back(checked("light", known_light));
  checks.push_back(checked("drawing", furnace));
  checks.push_back(checked("photos", readable_photos));
  checks.push_back(checked("device", [] {
    return "the processor, " + std::to_string(default_thread_count()) + " threads; no other is used";
  }));
  return checks;
}

}  // namespace faceprobe::pipeline
