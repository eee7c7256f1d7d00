#include "faceprobe/train/finetune.h"

#include "train/config_fields.h"

#include <array>
#include <cstdio>

namespace faceprobe::train {
namespace {

std::string fixed_number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

// Nothing where there was nothing before.
std::string change_percent(double after, double before) {
  if (!(before > 0)) return {};
  const double change = 100 * (after / before - 1);
  return (change < 0 ? "" : "+") + fixed_number(change, 1) + " %";
}

std::string why_kept(const FinetuneReport& report) {
  const std::string limit = short_number(100 * report.max_validation_rise) + " %";
  if (report.validated && report.after.step == 0) {
    return "kept is the start, because at every step that was scored the error on synthetic faces was more than " +
           limit + " above its own; lower the weight or the learning rate, or score more often";
  }
  std::string text = "kept is step " + std::to_string(report.after.step) + " of " + std::to_string(report.steps);
  if (report.validated)
    text += ", the last scored one whose error on synthetic faces is at most " + limit + " above the start's";
  return text;
}

std::string table_row(const char* name, const FinetuneScore& score, bool validated) {
  std::string text = std::string("| ") + name + " | " + std::to_string(score.step) + " | " +
                     fixed_number(score.residual, 5) + " | " + fixed_number(score.untouched, 5) + " | " +
                     fixed_number(score.energy, 4) + " |";
  if (validated) text += " " + fixed_number(score.synthetic_rmse, 2) + " |";
  return text + '\n';
}

}  // namespace

std::size_t kept_score(const std::vector<FinetuneScore>& scores, double max_rise) {
  const double limit = (1 + max_rise) * scores.front().synthetic_rmse;
  std::size_t kept = 0;
  for (std::size_t i = 1; i < scores.size(); ++i) {
    if (scores[i].synthetic_rmse <= limit) kept = i;
  }
  return kept;
}

std::string finetune_table(const FinetuneReport& report) {
  const bool validated = report.validated;
  std::string text = std::to_string(report.before.people) + " people held out; " + why_kept(report) +
                     ".\n\n| | step | beyond rank one | no highlights taken off | mean highlight |";
  text += validated ? " RMSE on synthetic skin, of 255 |\n" : "\n";
  text += std::string("| --- | ---: | ---: | ---: | ---: |") + (validated ? " ---: |\n" : "\n");
  text += table_row("before", report.before, validated) + table_row("after", report.after, validated);
  text += "| change | | " + change_percent(report.after.residual, report.before.residual) + " | | " +
          change_percent(report.after.energy, report.before.energy) + " |";
  if (validated) text += " " + change_percent(report.after.synthetic_rmse, report.before.synthetic_rmse) + " |";
  return text + '\n';
}

}  // namespace faceprobe::train
