// Highlight separators against polariser ground truth and published figures.
//
//   bench_separation --data DIR
//
// Prints one Markdown table per picture set. DIR/real/specsep_objects holds shen/ (Shen & Zheng 2013: 8-bit pictures)
// and mit/ (Grosse et al. 2009: 16-bit linear pictures on black); a missing set is skipped. Code values / 255 are fed
// as they are: that is what the published figures, those of the SIHR collection, were computed on. PSNR is that of the
// diffuse layer, over all pixels and channels, in 8 bits; "black layer" takes the whole picture for diffuse.

#include "faceprobe/core/image.h"
#include "faceprobe/highlight/separate.h"

#include <OpenImageIO/imageio.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using faceprobe::Image;
using faceprobe::highlight::Separator;

struct PictureSet {
  std::string folder;
  std::vector<std::string> names;
  // PSNR of names x separators as published; empty = none.
  std::vector<std::array<double, 3>> published;
};

const std::array<Separator, 3> kSeparators = {Separator::kTan, Separator::kYang, Separator::kShen};

std::vector<PictureSet> picture_sets() {
  return {{"shen",
           {"animals", "cups", "fruit", "masks"},
           {{30.4, 36.5, 37.5}, {31.6, 37.5, 38.3}, {30.4, 36.2, 38.2}, {25.8, 33.5, 32.7}}},
          {"mit", {"apple", "frog2", "pear", "teabag1", "teabag2"}, {}}};
}

// Values as the file has them, scaled to [0, 1]; three channels.
Image read_values(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw std::runtime_error("Cannot read " + path.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels < 3) throw std::runtime_error(path.string() + " has fewer than three channels.");
  Image image(spec.width, spec.height, 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.data())) {
    throw std::runtime_error("Cannot read " + path.string() + ": " + input->geterror());
  }
  return image;
}

double psnr(const Image& image, const Image& truth) {
  const auto byte = [](float value) { return std::round(255.0 * std::clamp(static_cast<double>(value), 0.0, 1.0)); };
  double sum = 0;
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const double difference = byte(image.values()[i]) - byte(truth.values()[i]);
    sum += difference * difference;
  }
  const double mean = sum / static_cast<double>(image.values().size());
  return mean > 0 ? 10 * std::log10(255.0 * 255.0 / mean) : std::numeric_limits<double>::infinity();
}

struct Timed {
  faceprobe::highlight::Layers layers;
  double seconds;
};

// The fastest of a few runs: the others shared the processor.
Timed run(const Image& picture, Separator separator, int threads, int repeats) {
  Timed best{{}, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    auto layers = faceprobe::highlight::separate(picture, {}, {.separator = separator, .threads = threads});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds < best.seconds) best = {std::move(layers), seconds};
  }
  return best;
}

void report(const PictureSet& set, const std::filesystem::path& folder, int threads, int repeats) {
  const bool published = !set.published.empty();
  std::printf("\n### %s\n\n| picture | pixels | separator | PSNR dB |%s black layer dB | s |\n", set.folder.c_str(),
              published ? " published dB | difference |" : "");
  std::printf("| --- | --- | --- | ---: |%s ---: | ---: |\n", published ? " ---: | ---: |" : "");
  for (std::size_t i = 0; i < set.names.size(); ++i) {
    const Image picture = read_values(folder / (set.names[i] + ".png"));
    const Image truth = read_values(folder / (set.names[i] + "_gt.png"));
    if (!picture.same_size(truth)) throw std::runtime_error(set.names[i] + " and its ground truth differ in size.");
    const double black = psnr(picture, truth);
    for (std::size_t k = 0; k < kSeparators.size(); ++k) {
      const Timed timed = run(picture, kSeparators[k], threads, repeats);
      const double value = psnr(timed.layers.diffuse, truth);
      std::printf("| %s | %d x %d | %s | %.1f |", set.names[i].c_str(), picture.width(), picture.height(),
                  std::string(faceprobe::highlight::separator_name(kSeparators[k])).c_str(), value);
      if (published) std::printf(" %.1f | %+.1f |", set.published[i][k], value - set.published[i][k]);
      std::printf(" %.1f | %.3f |\n", black, timed.seconds);
    }
  }
}

// A picture tiled to 4 megapixels: how long a full-resolution crop takes.
void report_speed(const std::filesystem::path& file, int threads, int repeats) {
  const Image tile = read_values(file);
  Image big(2000, 2000, 3);
  for (int y = 0; y < big.height(); ++y) {
    for (int x = 0; x < big.width(); ++x)
      std::copy_n(tile.pixel(x % tile.width(), y % tile.height()), 3, big.pixel(x, y));
  }
  std::printf("\n### Speed, %d x %d\n\n| separator | s |\n| --- | ---: |\n", big.width(), big.height());
  for (const Separator separator : kSeparators) {
    std::printf("| %s | %.3f |\n", std::string(faceprobe::highlight::separator_name(separator)).c_str(),
                run(big, separator, threads, repeats).seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"PSNR and time of the highlight separators on pictures with polariser ground truth"};
  std::string data;
  int threads = 0;
  int repeats = 3;
  app.add_option("--data", data, "Folder that holds real/specsep_objects")->required()->check(CLI::ExistingDirectory);
  app.add_option("--threads", threads, "Threads; 0 = all");
  app.add_option("--repeats", repeats, "Runs of which the fastest counts")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    const std::filesystem::path root = std::filesystem::path(data) / "real" / "specsep_objects";
    for (const PictureSet& set : picture_sets()) {
      if (std::filesystem::is_directory(root / set.folder)) report(set, root / set.folder, threads, repeats);
    }
    const auto sample = root / "shen" / "cups.png";
    if (std::filesystem::exists(sample)) report_speed(sample, threads, repeats);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
