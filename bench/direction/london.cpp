#include "paper/london.h"

#include "direction/direction.h"
#include "faceprobe/core/angles.h"
#include "paper/light_direction.h"
#include "support/statistics.h"

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::bench {

namespace {

using cli::direction_setting;
using highlight::Separator;
using lighting::Solver;
using pipeline::NormalSource;
using pipeline::ShadingSource;

std::vector<cli::DirectionSetting> settings_of(const pipeline::EstimateOptions& base) {
  std::vector<cli::DirectionSetting> all;
  for (const Solver solver : {Solver::kTransport, Solver::kPaper}) {
    for (const std::optional<Separator> classical : {std::optional<Separator>(), std::optional(Separator::kTan),
                                                     std::optional(Separator::kYang), std::optional(Separator::kShen)})
      all.push_back(direction_setting(solver, classical, base));
  }
  // What the prior is worth, and without it the network's normals and shading, one by one.
  for (const NormalSource normals : {NormalSource::kMesh, NormalSource::kNet}) {
    for (const ShadingSource shading : {ShadingSource::kRegions, ShadingSource::kNet}) {
      cli::DirectionSetting setting = direction_setting(Solver::kTransport, {}, base);
      setting.options.normals = normals;
      setting.options.shading = shading;
      setting.options.prior = pipeline::PriorSource::kSmooth;
      setting.name += std::string(", without the prior, normals of the ") +
                      (normals == NormalSource::kNet ? "net" : "mesh") + ", shading by " +
                      (shading == ShadingSource::kNet ? "net" : "region");
      all.push_back(std::move(setting));
    }
  }
  return all;
}

std::string angles_text(const Eigen::Vector3d& direction) {
  return cell(azimuth_deg(direction), 0) + " / " + cell(elevation_deg(direction), 0);
}

void print(const std::string& method, const eval::ScoreTable& scores) {
  const auto of = [&](const char* metric) { return answers(scores, metric, {.method = method}); };
  const auto mean_of = [&](const char* metric, int decimals = 1) { return cell(mean(of(metric)), decimals); };
  const std::vector<double> strongest = of("strongest_deg");
  const std::vector<double> off = of("centroid_off_deg");
  const Eigen::Vector3d centre(mean(of("centroid_x")), mean(of("centroid_y")), mean(of("centroid_z")));
  std::printf("| %s | %zu | %s | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", method.c_str(), strongest.size(),
              cell(mean(strongest)).c_str(), cell(median(strongest)).c_str(), mean_of("recall_deg").c_str(),
              mean_of("precision_deg").c_str(), mean_of("lights").c_str(),
              off.empty() ? "-" : angles_text(centre).c_str(), cell(mean(off)).c_str(), cell(quantile(off, 0.9)).c_str(),
              mean_of("neutral_to_smiling_deg").c_str(), mean_of("map_correlation", 2).c_str());
}

}  // namespace

void report_london(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base) {
  const cli::LondonSet london = cli::read_london(folder, every);
  const eval::ScoreTable scores = cli::measure_london(london, settings_of(base));
  std::printf(
      "\n### London: three studio lights\n\nAngles in degrees; %zu people, each neutral and smiling. Azimuth / "
      "elevation of the"
      " lights:",
      london.people.size());
  for (std::size_t i = 0; i < london.lights.size(); ++i)
    std::printf("%s %s", i > 0 ? "," : "", angles_text(london.lights[i]).c_str());
  std::printf(
      "; they are known to about 5 degrees. A person counts when both photos have an answer. Many lights make it easy "
      "to have"
      " one near each true light, so the next column asks the other way round; and a constant answer agrees with "
      "itself,"
      " so agreement counts only beside a small error. The last column is the correlation of the maps of two people, "
      "mean over all pairs.\n\n");
  std::printf(
      "| estimate | photos | strongest to nearest true: mean | median | true to nearest estimated | estimated to "
      "nearest"
      " true | lights | mean centroid | centroids off it: mean | 90 %% | neutral to smiling | maps alike |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const std::string& method : scores.methods()) print(method, scores);
}

}  // namespace faceprobe::bench
