// bench_best_case --data DIR: how well light comes back when everything but the light is known. The mean head of a parametric
// model seen frontally, lit by real HDR maps without cast shadows, Torrance-Sparrow highlights (m = .3, F0 = .028), relative noise;
// every estimator gets the same observations. Prints one Markdown table: relighting RMSE (0 - 255) of a diffuse and a mirror ball.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/lighting/estimate.h"
#include "faceprobe/lighting/recolour.h"
#include "faceprobe/lighting/trace.h"
#include "faceprobe/lighting/transport.h"
#include "support/head_normals.h"
#include "support/relighting.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <random>

namespace {

using namespace faceprobe;

struct Estimator {
  std::string name;
  lighting::SolveOptions options;
  bool trace_only = false;
};

std::vector<Estimator> estimators() {
  lighting::SolveOptions paper;
  paper.solver = lighting::Solver::kPaper;
  // Everything is known here, so nothing is fitted and no prior is needed.
  lighting::SolveOptions exact;
  exact.fit_highlight_gain = false;
  exact.max_leak = 0;
  exact.prior_weight = 0;
  lighting::SolveOptions shading = exact;
  shading.highlight_weight = 0;
  lighting::SolveOptions highlights = exact;
  highlights.highlight_weight = 1;
  highlights.shading_weight = 0;
  lighting::SolveOptions longer = highlights;
  longer.iterations = 150;
  lighting::SolveOptions both = exact;
  both.highlight_weight = 1;
  both.shading_weight = 0.1F;
  return {{"highlights traced, no deconvolution", paper, true},
          {"paper solver, 50 iterations", paper},
          {"shading alone, 50 iterations", shading},
          {"transport, highlights only, 50 iterations", highlights},
          {"transport, highlights only, 150 iterations", longer},
          {"transport, highlights 10 : shading 1", both},
          {"transport, defaults (for rough layers)", {}}};
}

void add_noise(Eigen::MatrixX3f& values, float sigma, std::mt19937& random) {
  std::normal_distribution<float> normal(0.0F, sigma);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (int c = 0; c < 3; ++c) values(i, c) = std::max(0.0F, values(i, c) * (1 + normal(random)));
  }
}

int run(const std::filesystem::path& data, int maps, float noise) {
  const SphereGrid grid(16);
  lighting::Observations face =
      bench::head_observations(data / "faces" / "ict_facekit" / "generic_neutral_mesh.obj", 60, 9409);
  const lighting::Transport transport = lighting::build_transport(face, grid);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(data / "hdri" / "dev")) {
    if (entry.path().extension() == ".hdr") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  files.resize(std::min(files.size(), static_cast<std::size_t>(maps)));

  std::vector<Estimator> rows = estimators();
  std::vector<bench::RelightingError> sums(rows.size());
  std::mt19937 random(1);
  int cases = 0;
  for (const std::filesystem::path& file : files) {
    const EnvMap map = io::read_env_map(file);
    for (const double yaw_deg : {0.0, 137.0}) {
      const Eigen::Matrix3f turn =
          Eigen::AngleAxisf(static_cast<float>(radians(yaw_deg)), Eigen::Vector3f::UnitY()).toRotationMatrix();
      const Eigen::MatrixX3f truth = grid_from_env_map(rotate(map, turn), grid);
      face.highlight = transport.highlight() * truth;
      face.shading = transport.diffuse() * truth;
      add_noise(face.highlight, noise, random);
      add_noise(face.shading, noise, random);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const Eigen::MatrixX3f estimate =
            rows[k].trace_only
                ? Eigen::MatrixX3f(lighting::trace_highlights(face, lighting::recolour_highlights(face), grid).value)
                : lighting::solve(face, rows[k].options).radiance;
        const bench::RelightingError error = bench::relighting_error(truth, estimate, grid);
        sums[k].diffuse += error.diffuse;
        sums[k].mirror += error.mirror;
      }
      ++cases;
    }
  }
  std::printf("%d lit faces (%zu maps x 2 rotations), %d patches, %.0f %% noise\n\n", cases, files.size(),
              static_cast<int>(face.count()), 100.0 * noise);
  std::printf("| estimator | diffuse | mirror |\n|---|---|---|\n");
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::printf("| %s | %.1f | %.1f |\n", rows[k].name.c_str(), sums[k].diffuse / cases, sums[k].mirror / cases);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Relighting error with everything known but the light");
  std::string data;
  int maps = 16;
  float noise = 0.03F;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--maps", maps, "HDR maps to use")->capture_default_str();
  app.add_option("--noise", noise, "relative noise")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return run(data, maps, noise);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
