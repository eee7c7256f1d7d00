// Highlight separators against polariser ground truth and published figures.
//
//   bench_separation --data DIR
//
// Prints one Markdown table per picture set, as apps/cli/paper/objects.h measures them, and how long the separators take. DIR/real/specsep_objects
// holds shen/ (Shen & Zheng 2013: 8-bit pictures) and mit/ (Grosse et al. 2009: 16-bit linear pictures on black); a missing set is skipped. PSNR
// is that of the diffuse layer, over all pixels and channels, in 8 bits; "black layer" takes the whole picture for diffuse.

#include "paper/objects.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace {

namespace cli = faceprobe::cli;
using faceprobe::Image;

void report(const faceprobe::eval::ScoreTable& scores, const std::string& set) {
  const auto& rows = scores.rows();
  const bool published = std::any_of(rows.begin(), rows.end(), [&](const faceprobe::eval::ScoreRow& row) {
    return row.groups.at("set") == set && row.metrics.contains("published");
  });
  std::printf("\n### %s\n\n| picture | pixels | separator | PSNR dB |%s black layer dB | s |\n", set.c_str(),
              published ? " published dB | difference |" : "");
  std::printf("| --- | --- | --- | ---: |%s ---: | ---: |\n", published ? " ---: | ---: |" : "");
  double black = 0;  // its row comes before those of the separators
  for (const faceprobe::eval::ScoreRow& row : rows) {
    if (row.groups.at("set") != set) continue;
    const double value = row.metrics.at("psnr_diffuse");
    if (!row.metrics.contains("seconds")) {
      black = value;
      continue;
    }
    std::printf("| %s | %s | %s | %.1f |", row.groups.at("picture").c_str(), row.groups.at("pixels").c_str(),
                row.method.c_str(), value);
    if (published) std::printf(" %.1f | %+.1f |", row.metrics.at("published"), value - row.metrics.at("published"));
    std::printf(" %.1f | %.3f |\n", black, row.metrics.at("seconds"));
  }
}

// A picture tiled to 4 megapixels: how long a full-resolution crop takes.
void report_speed(const std::filesystem::path& file, const cli::ObjectBenchmark& options) {
  const Image tile = cli::read_code_values(file);
  Image big(2000, 2000, 3);
  for (int y = 0; y < big.height(); ++y) {
    for (int x = 0; x < big.width(); ++x)
      std::copy_n(tile.pixel(x % tile.width(), y % tile.height()), 3, big.pixel(x, y));
  }
  std::printf("\n### Speed, %d x %d\n\n| separator | s |\n| --- | ---: |\n", big.width(), big.height());
  for (const faceprobe::highlight::Separator separator : cli::kObjectSeparators) {
    std::printf("| %s | %.3f |\n", std::string(faceprobe::highlight::separator_name(separator)).c_str(),
                cli::timed_separation(big, separator, options).seconds);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"PSNR and time of the highlight separators on pictures with polariser ground truth"};
  std::string data;
  cli::ObjectBenchmark options{.repeats = 3};
  app.add_option("--data", data, "Folder that holds real/specsep_objects")->required()->check(CLI::ExistingDirectory);
  app.add_option("--threads", options.threads, "Threads; 0 = all");
  app.add_option("--repeats", options.repeats, "Runs of which the fastest counts")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    const std::filesystem::path root = std::filesystem::path(data) / "real" / "specsep_objects";
    const faceprobe::eval::ScoreTable scores = cli::measure_objects(cli::object_pictures(root), options);
    for (const char* set : cli::kObjectSets) {
      if (!scores.known_values("psnr_diffuse", {.group = "set", .label = set}).empty()) report(scores, set);
    }
    const auto sample = root / "shen" / "cups.png";
    if (std::filesystem::exists(sample)) report_speed(sample, options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
