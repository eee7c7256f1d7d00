// bench_highlight_net --data DIR [--weights FILE]: what the face network costs. Loading, a crop of a face, and the layers of whole
// photos (DIR/real/portraits/london_fullres, enlarged to 12 MP) at their full size, less the search for the face. Prints a Markdown table.

#include "faceprobe/core/error.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/net/face_net.h"
#include "faceprobe/pipeline/estimate.h"
#include "support/photos.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace faceprobe;

double median_ms(int times, const std::function<void()>& work) {
  std::vector<double> ms;
  for (int i = 0; i < times; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  return bench::median(ms);
}

void row(const std::string& what, double ms, const std::string& allowed) {
  std::printf("| %s | %.0f | %s |\n", what.c_str(), ms, allowed.c_str());
}

Image waves(int width, int height) {
  Image picture(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) picture(x, y, c) = 0.4F + 0.3F * static_cast<float>((x * (c + 1) + y) % 64) / 64.0F;
    }
  }
  return picture;
}

// To 12 million pixels, as phones take them.
io::Photo enlarged(io::Photo photo) {
  face::Crop crop{.x_px = 0, .y_px = 0};
  crop.scale = std::sqrt(12e6 / static_cast<double>(photo.linear.pixel_count()));
  crop.width = static_cast<int>(crop.scale * photo.linear.width());
  crop.height = static_cast<int>(crop.scale * photo.linear.height());
  photo.clipped = face::crop_flags(photo.clipped, crop);
  photo.linear = face::crop_picture(photo.linear, crop);
  return photo;
}

void report(const std::filesystem::path& data, const std::filesystem::path& weights, int threads) {
  const net::FaceNetOptions options{.threads = threads};
  std::printf("| what | ms, median | target |\n| --- | ---: | ---: |\n");
  row("load the weights, fp16", median_ms(9, [&] { net::FaceNet load(weights, options); }), "150");
  const auto begin = std::chrono::steady_clock::now();
  const net::FaceNet network(weights, options);
  const Image small = waves(128, 128);
  (void)network.layers(small, {}, {}, {});
  row("load and take the first crop of 128 px",
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count(), "-");
  row("crop of 128 px, both ways", median_ms(21, [&] { (void)network.layers_both_ways(small, {}, {}, {}); }), "-");
  row("crop of 128 px", median_ms(21, [&] { (void)network.layers(small, {}, {}, {}); }), "-");
  const Image crop = waves(256, 256);
  row("crop of 256 px", median_ms(21, [&] { (void)network.layers(crop, {}, {}, {}); }), "80");
  row("crop of 256 px, both ways", median_ms(21, [&] { (void)network.layers_both_ways(crop, {}, {}, {}); }), "80");
  for (const bool classical : {false, true}) {
    pipeline::EstimateOptions estimate_options;
    estimate_options.threads = threads;
    estimate_options.weights = weights;
    estimate_options.classical.reset();
    if (classical) estimate_options.classical = highlight::Separator::kYang;
    const pipeline::Estimator estimator(estimate_options);
    const std::vector<std::filesystem::path> files = bench::photos_below(data / "real" / "portraits" / "london_fullres");
    if (files.empty()) throw Error(ExitCode::kInput, "There are no photos in real/portraits/london_fullres.");
    for (const auto& file : files) {
      const io::Photo photo = enlarged(io::load_photo(file));
      char size[64];
      std::snprintf(size, sizeof size, "%.1f MP", static_cast<double>(photo.linear.pixel_count()) * 1e-6);
      const std::string name = file.stem().string() + ", " + size;
      const double find = median_ms(5, [&] { (void)estimator.find_faces(photo); });
      const double all = median_ms(5, [&] { (void)estimator.separate(photo); });
      if (!classical) row("find the face of " + name, find, "-");
      row("layers of " + name + ", " + estimate_options.separator_name() + ", its face known", all - find,
          classical ? "-" : "600");
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What the face network costs");
  std::string data;
  std::string weights;
  int threads = 0;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--weights", weights, "weights in place of those that come with the program");
  app.add_option("--threads", threads, "0 = all")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    report(data, weights.empty() ? io::data_file("face.safetensors") : std::filesystem::path(weights), threads);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
  return 0;
}
