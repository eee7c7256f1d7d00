#include "eval_stages.h"
#include "faceprobe/eval/geometry_benchmark.h"
#include "faceprobe/eval/paper_report.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/net/face_net.h"
#include "one_head.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace faceprobe::cli {

namespace {

eval::GeometryMethod network(const std::string& named, int threads) {
  const auto [name, file] = name_and_file(named);
  auto net = std::make_shared<net::FaceNet>(file, net::FaceNetOptions{.threads = threads});
  return {name, [net](const eval::PhotoInput& input) -> eval::GeometryEstimate {
            net::FaceLayers layers = net->layers_both_ways(input.linear, input.clip, input.mask, input.mesh_normal_cam);
            return {std::move(layers.normal_cam), std::move(layers.normal_error_rad), std::move(layers.region)};
          }};
}

std::string parts_table(const eval::ScoreTable& table) {
  constexpr const char* kParts[] = {"forehead", "nose", "cheeks",  "upper_lip", "lips",
                                    "chin",     "jaw",  "eyelids", "brows"};
  std::string text = "| method |";
  std::string line = "|---|";
  std::vector<std::string> metrics;
  for (const std::string& metric : table.metrics()) {
    if (metric.starts_with("normal_") && metric != "normal_median") metrics.push_back(metric);
  }
  const auto place = [&](const std::string& metric) {
    return std::find(std::begin(kParts), std::end(kParts), metric.substr(7)) - std::begin(kParts);
  };
  std::sort(metrics.begin(), metrics.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
  for (const std::string& metric : metrics) {
    text += " " + metric.substr(7) + " |";
    line += "---:|";
  }
  text += "\n" + line + "\n";
  for (const std::string& method : table.methods()) {
    text += "| " + method + " |";
    for (const std::string& metric : metrics)
      text += fmt::format(" {:.1f} |", table.summary(metric, {.method = method}).mean);
    text += "\n";
  }
  return text;
}

std::string calibration_table(const std::vector<eval::CalibrationBin>& bins) {
  std::string stated = "| stated |";
  std::string real = "| true |";
  std::string head = "| tenth of the pixels |";
  std::string line = "|---|";
  for (std::size_t b = 0; b < bins.size(); ++b) {
    head += fmt::format(" {} |", b + 1);
    line += "---:|";
    stated += fmt::format(" {:.1f} |", bins[b].stated_deg);
    real += fmt::format(" {:.1f} |", bins[b].true_deg);
  }
  const eval::TrustThirds thirds = eval::thirds_of(bins);
  return head + "\n" + line + "\n" + stated + "\n" + real +
         fmt::format(
             "\n\nThe third that it trusts most is off by {:.1f}, the third that it trusts least by {:.1f}: a ratio of "
             "{:.2f}.\n",
             thirds.best_deg, thirds.worst_deg, thirds.best_deg / thirds.worst_deg);
}

// Stated against true errors, beside the line on which they would be the same.
eval::PaperReport calibration_page(const eval::GeometryScores& scores, const std::string& text) {
  eval::ReportPlot plot{.title = "Errors of normals that are stated and true",
                        .x_label = "stated, degrees",
                        .y_label = "true, degrees",
                        .kind = eval::PlotKind::kLines};
  double largest = 0;
  for (const auto& [method, bins] : scores.calibration) {
    eval::ReportSeries series{.name = method, .ours = true};
    for (const eval::CalibrationBin& bin : bins) {
      series.x.push_back(bin.stated_deg);
      series.values.push_back(bin.true_deg);
      largest = std::max(largest, bin.stated_deg);
    }
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back({.name = "the same", .values = {0, largest}, .x = {0, largest}});
  eval::PaperReport page{.title = "Normals and regions"};
  page.sections.push_back({.id = "calibration", .title = "Is the stated error the true one?", .text = text});
  page.sections.back().plots.push_back(std::move(plot));
  return page;
}

std::string overlap_table(const eval::GeometryScores& scores) {
  std::string text = "| region |";
  std::string line = "|---|";
  for (const auto& [method, overlap] : scores.region_overlap) {
    text += " " + method + " |";
    line += "---:|";
  }
  text += "\n" + line + "\n";
  for (int r = 0; r < kRegionCount; ++r) {
    text += "| " + std::string(region_name(static_cast<Region>(r))) + " |";
    for (const auto& [method, overlap] : scores.region_overlap) {
      const double share = overlap[static_cast<std::size_t>(r)];
      text += std::isfinite(share) ? fmt::format(" {:.3f} |", share) : " |";
    }
    text += "\n";
  }
  text += "| mean |";
  for (const auto& [method, overlap] : scores.region_overlap)
    text += fmt::format(" {:.3f} |", scores.mean_overlap(method));
  text += "\n| all skin |";
  for (const auto& [method, overlap] : scores.skin_overlap) text += fmt::format(" {:.3f} |", overlap);
  text += "\n| photos left out, without a face |";
  for (const auto& [method, overlap] : scores.region_overlap)
    text += fmt::format(" {} |", scores.without_face.at(method));
  return text + "\n";
}

std::string report(const eval::GeometryScores& scores, const EvalOptions& options) {
  const eval::ScoreTable& table = scores.table;
  std::string text = fmt::format("{} photos of {}.\n",
                                 table.rows().size() / std::max<std::size_t>(1, table.methods().size()), options.data);
  const auto section = [&](const std::string& title, const std::string& body) {
    text += "\n### " + title + "\n\n" + body;
  };
  section("Angle between normals on the skin, degrees, mean of each photo", table.markdown("normal", 2));
  section("The same, median of each photo", table.markdown("normal_median", 2));
  section("By part of the face", parts_table(table));
  section("By turn of the head from the camera, degrees", table.markdown_by_group("normal", "turn", 1));
  section("By skin tone", table.markdown_by_group("normal", "tone", 1));
  for (const auto& [method, bins] : scores.calibration)
    section("Error that " + method + " states, degrees", calibration_table(bins));
  section("Regions, intersection over union", overlap_table(scores));
  return text;
}

}  // namespace

int eval_geometry(const EvalOptions& options) {
  const synth::ShardReader faces(options.data);
  auto finder = std::make_shared<face::FaceFinder>(
      face::FinderOptions{.min_face_px = face::kSmallFacePx, .threads = options.threads});
  std::vector<eval::GeometryMethod> methods = {eval::mesh_method(finder)};
  if (!options.head.empty())
    methods.push_back(eval::surface_method("3dmm", finder, surface_of_head(options.head, options.threads)));
  for (const std::string& weights : options.weights) methods.push_back(network(weights, options.threads));
  const eval::GeometryScores scores =
      eval::measure_geometry(faces, methods, {.samples = options.samples, .progress = eval_progress()});
  fmt::print("{}", report(scores, options));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "geometry.csv", scores.table.csv());
  io::write_file_atomically(folder / "geometry.json", scores.table.json());
  if (!scores.calibration.empty()) {
    io::write_file_atomically(
        folder / "calibration.html",
        eval::report_html(calibration_page(
            scores, "Each point is a tenth of the skin's pixels, by the error that is stated for them.")));
  }
  io::write_picture(folder / "geometry.png", eval::draw_geometry(faces, methods, options.rows));
  return 0;
}

}  // namespace faceprobe::cli
