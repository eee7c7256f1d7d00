#include "commands.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/highlight_benchmark.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/net/both_ways.h"
#include "faceprobe/net/torch_highlight_net.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <memory>

namespace faceprobe::cli {

namespace {

struct Options {
  std::string what;
  std::string data;
  std::vector<std::string> weights;
  std::string output;
  std::string device = "auto";
  int rows = 12;
  eval::HighlightBenchmark benchmark;
};

eval::HighlightMethod classical(highlight::Separator separator, int threads) {
  return {std::string(highlight::separator_name(separator)),
          [separator, threads](const Image& linear, const ByteImage&, const ByteImage& mask) {
            return highlight::separate(linear, mask, {.separator = separator, .threads = threads}).highlight;
          }};
}

// NAME=FILE, or FILE, which is then its name.
eval::HighlightMethod network(const std::string& named, const net::TorchHighlightNetOptions& options) {
  const std::size_t equals = named.find('=');
  const std::string file = equals == std::string::npos ? named : named.substr(equals + 1);
  const std::string name =
      equals == std::string::npos ? std::filesystem::path(file).stem().string() : named.substr(0, equals);
  auto net = std::make_shared<net::TorchHighlightNet>(file, options);
  return {name, [net](const Image& linear, const ByteImage& clip, const ByteImage& mask) {
            return net::highlight_both_ways(*net, linear, clip, mask);  // as estimate does
          }};
}

std::string report(const eval::ScoreTable& table, const Options& options) {
  std::string text;
  const auto section = [&](const char* title, const std::string& body) {
    text += std::string("\n### ") + title + "\n\n" + body;
  };
  section("RMSE on the face's skin, 0-255", table.markdown("rmse_skin", 2));
  section("SSIM on the face's skin", table.markdown("ssim_skin", 3));
  section("RMSE on the whole crop, 0-255", table.markdown("rmse_whole", 2));
  section("SSIM on the whole crop", table.markdown("ssim_whole", 3));
  section("RMSE on the skin by tone", table.markdown_by_group("rmse_skin", "tone", 2));
  section("RMSE on the skin by clipped share", table.markdown_by_group("rmse_skin", "clipped", 2));
  section("RMSE on the skin by its share of the crop", table.markdown_by_group("rmse_skin", "size", 2));
  std::string histogram = "| method |";
  for (int i = 0; i < 10; ++i) histogram += fmt::format(" {}-{} |", 3 * i, 3 * i + 3);
  histogram += " more |\n|---|" + std::string(11 * 4, '-') + "|\n";
  for (const std::string& method : table.methods()) {
    const eval::Histogram bins = table.histogram("rmse_skin", {.method = method}, 0, 30, 10);
    histogram += "| " + method + " |";
    for (const auto count : bins.counts) histogram += fmt::format(" {} |", count);
    histogram += fmt::format(" {} |\n", bins.above);
  }
  section("How many photos have which RMSE on the skin", histogram);
  return fmt::format("{} photos of {}.\n", table.rows().size() / std::max<std::size_t>(1, table.methods().size()),
                     options.data) +
         text;
}

int run(Options options) {
  const synth::ShardReader faces(options.data);
  std::vector<eval::HighlightMethod> methods = {eval::black_method()};
  for (const highlight::Separator separator :
       {highlight::Separator::kTan, highlight::Separator::kYang, highlight::Separator::kShen})
    methods.push_back(classical(separator, options.benchmark.threads));
  const net::TorchHighlightNetOptions net_options{.threads = options.benchmark.threads,
                                                  .device = net::device_from_name(options.device)};
  for (const std::string& weights : options.weights) methods.push_back(network(weights, net_options));
  const bool terminal = isatty(STDERR_FILENO) != 0;
  options.benchmark.progress = [terminal](int done, int total) {
    if (terminal) fmt::print(stderr, "\r{} of {} photos{}", done, total, done == total ? "\n" : "");
  };
  const eval::ScoreTable table = eval::measure_highlights(faces, methods, options.benchmark);
  fmt::print("{}", report(table, options));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "highlight.csv", table.csv());
  io::write_file_atomically(folder / "highlight.json", table.json());
  io::write_picture(folder / "highlight.png", eval::draw_highlights(faces, methods, options.rows));
  return 0;
}

}  // namespace

void add_eval(CLI::App& program, Action& action) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("eval", "measures a stage on data whose answer is known");
  command->add_option("STAGE", options->what, "what to measure")->required()->check(CLI::IsMember({"highlight"}));
  command->add_option("--data", options->data, "folder that `faceprobe synth` wrote")->required();
  command->add_option("--weights", options->weights,
                      "networks to measure beside the classical separators: FILE or NAME=FILE");
  command->add_option("--samples", options->benchmark.samples, "photos, spread evenly over the data")
      ->capture_default_str();
  command->add_option("-o,--output", options->output, "folder for highlight.csv, .json and a picture of the layers");
  command->add_option("--rows", options->rows, "photos in that picture")->capture_default_str()->check(CLI::Range(1, 200));
  command->add_option("--device", options->device, "auto, cpu, cuda or cuda:N")->capture_default_str();
  command->add_option("--threads", options->benchmark.threads, "0 = all processors")->capture_default_str();
  command->footer(
      "Prints Markdown.\n\nExample:\n  faceprobe eval highlight --data faces/dev --weights run/weights.safetensors -o "
      "out");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace faceprobe::cli
