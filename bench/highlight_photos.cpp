// bench_highlight_photos --data DIR [--weights FILE] -o OUT: highlight layers of real photos, whose truth nobody knows.
//
// Draws contact sheets to look at: OUT/london.png, selfies.png, hardcases.png, each face as photo, highlight (lightened) and diffuse. And
// prints for people who were photographed neutral and smiling under the same lights (DIR/real/portraits/london) how well their two
// highlight layers agree where a face is rigid: brought into the mesh's own square, the correlation over forehead and nose.

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/estimate.h"
#include "faceprobe/pipeline/largest_face.h"
#include "support/cells.h"
#include "support/photos.h"
#include "support/square.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace faceprobe;
namespace fs = std::filesystem;

constexpr int kCellPx = 160;
constexpr int kSquarePx = 96;
constexpr float kLighten = 4.0F;  // highlights of skin are about a tenth of its light

void draw_sheet(const pipeline::Estimator& estimator, const std::vector<fs::path>& files, const fs::path& to) {
  constexpr int kAcross = 4;  // faces of three cells each
  std::vector<pipeline::FaceEstimate> faces;
  for (const fs::path& file : files) {
    if (auto face = pipeline::find_largest_face(estimator, io::load_photo(file))) faces.push_back(std::move(*face));
  }
  if (faces.empty())
    throw Error(ExitCode::kInput, "There are no photos with a face for " + to.filename().string() + ".");
  const int rows = (static_cast<int>(faces.size()) + kAcross - 1) / kAcross;
  ByteImage sheet(3 * kAcross * kCellPx, rows * kCellPx, 3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int x = static_cast<int>(i) % kAcross * 3 * kCellPx;
    const int y = static_cast<int>(i) / kAcross * kCellPx;
    bench::put_cell(faces[i].picture, 1, kCellPx, x, y, sheet);
    bench::put_cell(faces[i].layers.highlight, kLighten, kCellPx, x + kCellPx, y, sheet);
    bench::put_cell(faces[i].layers.diffuse, 1, kCellPx, x + 2 * kCellPx, y, sheet);
  }
  io::write_picture(to, sheet);
}

// A face's highlight, as luminance, in the mesh's square.
struct Flat {
  Image highlight;
  ByteImage seen;
};

Flat flatten(const pipeline::FaceEstimate& estimate, const train::FaceTemplate& square) {
  const train::Warp warp = bench::warp_of(estimate, square);
  const Image& layer = estimate.layers.highlight;
  Image grey(layer.width(), layer.height(), 1);
  for (std::size_t i = 0; i < grey.pixel_count(); ++i) grey.data()[i] = luminance(layer.data() + 3 * i);
  return {train::sample(grey, warp), train::seen(warp)};
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double mean_a = bench::mean(a);
  const double mean_b = bench::mean(b);
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

double agreement(const Flat& a, const Flat& b, const ByteImage& regions) {
  std::vector<double> first, second;
  for (std::size_t i = 0; i < regions.pixel_count(); ++i) {
    const auto region = static_cast<Region>(regions.data()[i]);
    const bool rigid = region == Region::kForehead || region == Region::kNose;
    if (!rigid || a.seen.data()[i] == 0 || b.seen.data()[i] == 0) continue;
    first.push_back(static_cast<double>(a.highlight.data()[i]));
    second.push_back(static_cast<double>(b.highlight.data()[i]));
  }
  return first.size() < 100 ? std::nan("") : correlation(first, second);
}

void report_agreement(const fs::path& london, const std::vector<pipeline::EstimateOptions>& settings) {
  const std::map<std::string, std::array<fs::path, 2>> people = bench::london_pairs(london);
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  const train::FaceTemplate square = train::face_template(mesh, kSquarePx);
  const ByteImage regions = train::template_regions(square, face::triangle_regions(mesh));
  std::printf(
      "Correlation of the highlight layers of one person, neutral and smiling, over forehead and nose:\n\n"
      "| separator | people | mean | median | 10 %% | least | at least .8 |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const pipeline::EstimateOptions& options : settings) {
    const pipeline::Estimator estimator(options);
    std::vector<double> values;
    for (const auto& [id, files] : people) {
      if (files[0].empty() || files[1].empty()) continue;
      const auto neutral = pipeline::find_largest_face(estimator, io::load_photo(files[0]));
      const auto smiling = pipeline::find_largest_face(estimator, io::load_photo(files[1]));
      if (!neutral || !smiling) continue;
      const double value = agreement(flatten(*neutral, square), flatten(*smiling, square), regions);
      if (std::isfinite(value)) values.push_back(value);
    }
    std::printf("| %s | %zu | %s | %s | %s | %s | %s %% |\n", options.separator_name().c_str(), values.size(),
                bench::cell(bench::mean(values), 2).c_str(), bench::cell(bench::median(values), 2).c_str(),
                bench::cell(bench::quantile(values, 0.1), 2).c_str(), bench::cell(bench::quantile(values, 0), 2).c_str(),
                bench::cell(100 - 100 * bench::share_below(values, 0.8), 0).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Highlight layers of real photos");
  std::string data;
  std::string weights;
  std::string output = "out/highlight_photos";
  bool sheets = true;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--weights", weights, "weights in place of those that come with the program");
  app.add_option("-o,--out", output, "folder for the sheets")->capture_default_str();
  app.add_flag("!--no-sheets", sheets, "only the table");
  CLI11_PARSE(app, argc, argv);
  try {
    const fs::path real = fs::path(data) / "real";
    pipeline::EstimateOptions network;
    network.classical.reset();
    network.weights = weights;
    network.layer_px = 2 * kSquarePx;  // more would alias in the square
    if (sheets) {
      io::create_folder(output);
      const pipeline::Estimator estimator(network);
      std::vector<fs::path> london = bench::photos_below(real / "portraits" / "london" / "neutral_front");
      draw_sheet(estimator, london, fs::path(output) / "london.png");
      draw_sheet(estimator, bench::photos_below(real / "portraits" / "cc0_selfies"), fs::path(output) / "selfies.png");
      draw_sheet(estimator, bench::photos_below(real / "hardcases"), fs::path(output) / "hardcases.png");
    }
    std::vector<pipeline::EstimateOptions> settings = {network};
    for (const auto separator : {highlight::Separator::kTan, highlight::Separator::kYang, highlight::Separator::kShen}) {
      settings.emplace_back();
      settings.back().classical = separator;
      settings.back().layer_px = network.layer_px;
    }
    report_agreement(real / "portraits" / "london", settings);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
