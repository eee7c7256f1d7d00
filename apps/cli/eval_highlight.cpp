#include "eval_stages.h"
#include "faceprobe/eval/highlight_benchmark.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "highlight_methods.h"

#include <spdlog/fmt/fmt.h>

namespace faceprobe::cli {

namespace {

std::string report(const eval::ScoreTable& table, const EvalOptions& options) {
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

}  // namespace

int eval_highlight(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  std::vector<eval::HighlightMethod> methods = classical_highlight_methods(options.threads);
  refuse_missing_device(options.device);
  for (const std::string& weights : options.weights)
    methods.push_back(network_highlight_method(weights, options.device, options.threads));
  eval::ScoreTable table = eval::measure_highlights(
      faces, methods, {.samples = options.samples, .threads = options.threads, .progress = eval_progress()});
  if (!options.weights.empty()) table.compare_with(methods.back().name);  // the network named last
  fmt::print("{}", report(table, options));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "highlight.csv", table.csv());
  io::write_file_atomically(folder / "highlight.json", table.json());
  io::write_picture(folder / "highlight.png", eval::draw_highlights(faces, methods, options.rows));
  return 0;
}

}  // namespace faceprobe::cli
