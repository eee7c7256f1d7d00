#include "paper/yale.h"

#include "direction/direction.h"
#include "support/statistics.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace faceprobe::bench {

namespace {

using cli::direction_setting;
using highlight::Separator;
using lighting::Solver;

std::vector<cli::DirectionSetting> settings_of(const pipeline::EstimateOptions& base) {
  std::vector<cli::DirectionSetting> settings;
  settings.push_back(direction_setting(Solver::kTransport, {}, base));
  settings.push_back(direction_setting(Solver::kTransport, Separator::kYang, base));
  settings.back().name = "transport, classical";
  settings.push_back(direction_setting(Solver::kTransport, {}, base));
  settings.back().name = "transport, net, without the prior";
  settings.back().options.prior = pipeline::PriorSource::kSmooth;
  settings.push_back(direction_setting(Solver::kPaper, {}, base));
  settings.push_back(direction_setting(Solver::kTransport, {}, base));
  settings.back().name = "transport, net, codes taken for sRGB";
  settings.back().linear_codes = false;
  return settings;
}

void print(const std::string& name, const eval::ScoreTable& scores, const std::string& method,
           const std::string& metric, std::size_t pictures) {
  const std::vector<double> errors = answers(scores, metric, {.method = method});
  // Shares are of all pictures: no answer is no good answer.
  const auto share = [&](double limit_deg) {
    const double good = errors.empty() ? 0 : share_below(errors, limit_deg);
    return cell(100 * good * static_cast<double>(errors.size()) / static_cast<double>(pictures), 0);
  };
  std::printf("| %s | %zu | %s | %s | %s | %s %% | %s %% |", name.c_str(), errors.size(), cell(mean(errors)).c_str(),
              cell(median(errors)).c_str(), cell(quantile(errors, 0.9)).c_str(), share(15).c_str(), share(30).c_str());
  for (const std::string& label : cli::yale_flash_labels())
    std::printf(" %s |", cell(median(answers(scores, metric, {method, "flash", label}))).c_str());
  std::printf("\n");
}

}  // namespace

void report_yale(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base) {
  const std::vector<cli::YalePicture> pictures = cli::yale_pictures(folder, every);
  const std::vector<cli::DirectionSetting> settings = settings_of(base);
  const eval::ScoreTable scores = cli::measure_yale(pictures, settings);
  const std::vector<double> face = scores.known_values("face");
  std::printf(
      "### Yale B: one flash\n\nAngles in degrees between the estimate and the flash, %zu pictures with the flash up to"
      " %.0f degrees off the camera axis; the last columns by that angle. The pictures are grey, so"
      " the classical separators find no highlights and all three give the same. Their code values are taken for "
      "linear light unless the row says otherwise. Estimates that "
      "found"
      " no face: %zu.\n\n",
      pictures.size(), cli::kYaleMaxAxisDeg, static_cast<std::size_t>(std::count(face.begin(), face.end(), 0.0)));
  std::printf("| estimate | answers | mean | median | 90 %% | < 15 | < 30 |");
  for (const std::string& label : cli::yale_flash_labels()) std::printf(" median at %s |", label.c_str());
  std::printf("\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  print(cli::kStraightAhead, scores, cli::kStraightAhead, "main_light_deg", pictures.size());
  for (const cli::DirectionSetting& setting : settings) {
    // One for each way to take the codes: it depends on little else.
    if (setting.options.classical || !setting.linear_codes) {
      print("single lamp by least squares" + std::string(setting.linear_codes ? "" : ", codes taken for sRGB"), scores,
            setting.name, "lamp_deg", pictures.size());
    }
    print(setting.name + ": main light", scores, setting.name, "main_light_deg", pictures.size());
    print(setting.name + ": energy centroid", scores, setting.name, "centroid_deg", pictures.size());
  }
}

}  // namespace faceprobe::bench
