// bench_solve: what lighting::solve costs. First against the same products as a naive dense double-precision loop and in NumPy, all in this one run;
// then by the number of patches and of cells, with the power of the number that the time grows by. The observations are synthetic, of a light that is
// known, and need no data. Prints Markdown. Ends with 1 when the others' products come to another light than ours.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/lighting/estimate.h"
#include "solve/by_numpy.h"
#include "solve/observations.h"
#include "solve/products.h"
#include "solve/stopwatch.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace faceprobe;
using bench::Products;

constexpr int kPatches = 1000;
constexpr int kNside = 16;
constexpr double kMostDeviation = 0.01;  // of lights; rounding in float moves them by less

struct Options {
  int threads = 0;
  int runs = 7;
  std::string python = "/usr/bin/python3";  // Debian's NumPy belongs to this one
};

// Median seconds of `work`, after one run that nobody counts.
template <class Work>
double seconds(int runs, const Work& work) {
  work();
  std::vector<double> times;
  for (int run = 0; run < runs; ++run) {
    const bench::Stopwatch watch;
    work();
    times.push_back(watch.seconds());
  }
  return bench::median(times);
}

double solve_seconds(const lighting::Observations& face, int nside, int threads, int runs) {
  return seconds(runs, [&] { lighting::solve(face, {.nside = nside, .threads = threads}); });
}

// Between the lamp that is there and the brightest cell that is found.
double lamp_error_deg(const lighting::Light& light, const SphereGrid& grid) {
  Eigen::Index brightest = 0;
  (light.radiance * kLuminanceWeights).maxCoeff(&brightest);
  return angle_between_deg(grid.direction(static_cast<int>(brightest)).cast<double>(),
                           bench::solve_lamp().cast<double>());
}

void row(const std::string& what, double time, double of) {
  std::printf("| %s | %.1f | %.2f |\n", what.c_str(), 1e3 * time, time / of);
}

// Median over runs of one way of the products; the last run's result.
template <class Way>
double products_seconds(int runs, Products::Result& result, const Way& way) {
  std::vector<double> times;
  for (int run = 0; run < runs; ++run) {
    result = way();
    times.push_back(result.seconds);
  }
  return bench::median(times);
}

int against_others(const Options& options) {
  const lighting::Observations face = bench::solve_observations(kPatches);
  const SphereGrid grid(kNside);
  const double solve = solve_seconds(face, kNside, options.threads, options.runs);
  const double alone = options.threads > 1 ? solve_seconds(face, kNside, 1, options.runs) : solve;
  const double matrices = seconds(options.runs, [&] { lighting::build_transport(face, grid, options.threads); });
  const Products products = bench::make_products(face, kNside, options.threads);
  Products::Result ours;
  Products::Result naive;
  const double library =
      products_seconds(options.runs, ours, [&] { return bench::by_library(products, options.threads); });
  const double loop =
      products_seconds(std::min(3, options.runs), naive, [&] { return bench::by_double_loop(products); });
  const std::optional<bench::NumpyRuns> numpy = bench::by_numpy(products, options.python, options.threads, options.runs);

  std::printf(
      "%d patches, %d cells, %d threads; median of %d runs, of the loop %d. The products are those of a solve, by "
      "themselves: %.2f billion multiplications.\n\n",
      kPatches, grid.cell_count(), options.threads, options.runs, std::min(3, options.runs),
      1e-9 * products.multiplications());
  std::printf("| | ms | over the solve |\n|---|---:|---:|\n");
  row("`lighting::solve`", solve, solve);
  if (options.threads > 1) row("the same on one thread", alone, solve);
  row("its transport matrices alone", matrices, solve);
  row("its products alone", library, solve);
  row("the products as a dense loop in double precision, one thread", loop, solve);
  std::vector<double> off = {bench::deviation(naive, ours)};
  if (numpy) {
    for (const bench::NumpyRuns::Kind& kind : numpy->kinds) {
      row("the products in NumPy " + numpy->version + ", " + kind.name, bench::median(kind.seconds), solve);
      off.push_back(bench::deviation(kind.result, ours));
    }
    std::printf("\nNumPy's products are done by %s.\n", numpy->libraries.empty() ? "itself" : numpy->libraries.c_str());
  } else {
    std::printf("\nNumPy is left out: %s has none; install python3-numpy, or name another with --python.\n",
                options.python.c_str());
  }
  const lighting::Light light = lighting::solve(face, {.nside = kNside, .threads = options.threads});
  std::printf(
      "\nThe lights that these products come to differ from ours by %.1e of their size at most. The brightest cell of "
      "the solve is %.1f degrees from the lamp.\n",
      *std::max_element(off.begin(), off.end()), lamp_error_deg(light, grid));
  return std::all_of(off.begin(), off.end(), [](double value) { return value < kMostDeviation; }) ? 0 : 1;  // nor NaN
}

struct Point {
  double size, seconds;
};

// Slope of log time by log size, least squares: 1 where time grows as the size.
double growth(const std::vector<Point>& points) {
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Point& point : points) {
    const double lx = std::log(point.size), ly = std::log(point.seconds);
    x += lx;
    y += ly;
    xx += lx * lx;
    xy += lx * ly;
  }
  const auto n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void by_size(const char* what, const char* one, const std::vector<Point>& points) {
  std::printf("| %s | ms | us per %s |\n|---:|---:|---:|\n", what, one);
  for (const Point& point : points)
    std::printf("| %.0f | %.1f | %.1f |\n", point.size, 1e3 * point.seconds, 1e6 * point.seconds / point.size);
  const double power = growth(points);
  std::printf("\nTime grows as the number of %s to the power of %.2f: %s.\n", what, power,
              power <= 1.1 ? "linearly or slower" : "faster than linearly");
}

int run(const Options& options) {
  const int code = against_others(options);
  std::vector<Point> patches;
  for (const int count : {250, 500, 1000, 2000, 4000})
    patches.push_back({static_cast<double>(count),
                       solve_seconds(bench::solve_observations(count), kNside, options.threads, options.runs)});
  std::printf("\n### By patches, %d cells\n\n", SphereGrid(kNside).cell_count());
  by_size("patches", "patch", patches);
  const lighting::Observations face = bench::solve_observations(kPatches);
  std::vector<Point> cells;
  for (const int nside : {8, 16, 32})
    cells.push_back({static_cast<double>(SphereGrid(nside).cell_count()),
                     solve_seconds(face, nside, options.threads, options.runs)});
  std::printf("\n### By cells, %d patches\n\n", kPatches);
  by_size("cells", "cell", cells);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What solving for the light costs, by patches and cells, and against the same products elsewhere");
  Options options;
  app.add_option("--threads", options.threads, "threads; 0 = all")->check(CLI::Range(0, 1024))->capture_default_str();
  app.add_option("--runs", options.runs, "of which the median is told")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--python", options.python, "program with NumPy")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (options.threads == 0) options.threads = default_thread_count();
  try {
    return run(options);
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
