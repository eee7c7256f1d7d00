// bench_insert_cycles [--object FILE] [--maps DIR]: inserted things against Blender's Cycles. The same thing on the same card under the
// same maps in both, in five materials, all bounces. Prints Markdown: how far the converged pictures are apart, and the time of
// either to equal error on the same number of threads. About an hour on two cores that do nothing else. Needs Blender 3.x.

#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"
#include "insert_cycles/comparison.h"
#include "insert_cycles/report.h"
#include "insert_cycles/scene.h"
#include "insert_cycles/sheet.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <utility>

int main(int argc, char** argv) {
  using namespace faceprobe;
  CLI::App app("Inserted things against Blender's Cycles");
  bench::InsertOptions options;
  std::filesystem::path sheet;
  std::vector<std::string> materials;
  app.add_option("--object", options.object, "the thing: OBJ, PLY, glTF or STL, +y up; a pot without it")
      ->check(CLI::ExistingFile);
  app.add_option("--maps", options.maps, "folder of maps, DATA/hdri/dev; those made in code alone without it")
      ->check(CLI::ExistingDirectory);
  app.add_option("--map-count", options.map_count, "how many of its maps")->check(CLI::Range(0, 3))->capture_default_str();
  app.add_option("--materials", materials, "some of diffuse, metal, mirror, plastic, glass; all without it")
      ->delimiter(',');
  app.add_option("-o,--out", options.folder, "folder for Blender's files")->capture_default_str();
  app.add_option("--sheet", sheet,
                 "PNG to write: ours, Cycles' and 10 x the difference; rows of materials, columns of maps");
  app.add_option("--blender", options.blender, "Blender's program")->capture_default_str();
  app.add_option("--size", options.size_px, "width and height, pixels")->check(CLI::Range(32, 1024))->capture_default_str();
  app.add_option("--samples", options.cycles_samples, "Cycles' samples per pixel of the converged pictures")
      ->check(CLI::Range(2, 65536))
      ->capture_default_str();
  app.add_option("--our-samples", options.our_samples, "ours")->check(CLI::Range(2, 131072))->capture_default_str();
  app.add_option("--timed", options.timed_samples, "samples of the timed pictures, two numbers or more")
      ->delimiter(',')
      ->expected(2, 10)
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  app.add_option("--threads", options.threads, "of either renderer")->check(CLI::Range(1, 256))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  if (bench::blender_version(options.blender).empty()) {
    std::cerr << "There is no Blender (" << options.blender
              << "); install Debian's package blender, or name the program with --blender.\n";
    return static_cast<int>(ExitCode::kUsage);
  }
  try {
    std::vector<bench::Case> cases;
    std::vector<std::vector<bench::Pair>> rows;
    for (std::size_t i = 0; i < bench::test_materials().size(); ++i) {
      const std::string& name = bench::test_materials()[i].name;
      if (!materials.empty() && std::find(materials.begin(), materials.end(), name) == materials.end()) continue;
      rows.emplace_back();
      for (bench::Case& one : bench::compare_material(i, options)) {
        rows.back().push_back(one.pair);
        cases.push_back(std::move(one));
      }
    }
    if (cases.empty())
      throw Error(ExitCode::kUsage, "--materials names none of diffuse, metal, mirror, plastic, glass.");
    if (!sheet.empty()) bench::write_sheet(sheet, rows);
    bench::print_same_picture(cases, options);
    bench::print_time(cases, options);
    return 0;
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
