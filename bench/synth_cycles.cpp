// bench_synth_cycles --data DIR: synthetic faces against Blender's Cycles. The same head, camera, maps and material in both, direct
// light; Lambert and a rough mirror apart. Prints Markdown: errors per map, how they come about (a brute-force sum over all texels
// stands between the two), which side a red lamp lights, and the time of either at equal error. Needs Blender 3.x.

#include "cycles/report.h"
#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"

#include <CLI/CLI.hpp>
#include <iostream>

int main(int argc, char** argv) {
  using namespace faceprobe;
  CLI::App app("Synthetic faces against Blender's Cycles");
  bench::ComparisonOptions options;
  bool no_speed = false;
  app.add_option("--data", options.data, "data folder (docs/data.md)")->required();
  app.add_option("-o,--out", options.folder, "folder for pictures and Blender's files")->capture_default_str();
  app.add_option("--blender", options.blender, "Blender's program")->capture_default_str();
  app.add_option("--maps", options.maps, "maps to use")->check(CLI::Range(1, 8))->capture_default_str();
  app.add_option("--size", options.size_px, "width and height, pixels")->check(CLI::Range(32, 1024))->capture_default_str();
  app.add_option("--samples", options.samples, "Cycles' samples per pixel")
      ->check(CLI::Range(2, 65536))
      ->capture_default_str();
  app.add_option("--pixels", options.check_pixels, "pixels to sum by brute force")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  app.add_option("--nside", options.nside, "cells of the transport: 12 nside^2")
      ->check(CLI::Range(4, 64))
      ->capture_default_str();
  app.add_option("--images", options.images_per_view, "images of a view in the timing")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "0 = all")->capture_default_str();
  app.add_flag("--no-speed", no_speed, "leave out the timing");
  CLI11_PARSE(app, argc, argv);
  try {
    bench::require_blender(options.blender);
    const bench::Comparison comparison = bench::compare_with_cycles(options);
    bench::print_errors(comparison, options);
    bench::print_lamp(comparison);
    bench::draw(comparison, options.folder);
    if (!no_speed) bench::compare_speed(comparison, options);
    return 0;
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
