#include "train/finetune_state.h"

#include "train/curves.h"
#include "train/table.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <utility>

namespace faceprobe::train {
namespace {

constexpr std::size_t kFinetuneRowNumbers = 5;
constexpr std::size_t kScoreNumbers = 6;

using RowNumbers = std::array<double, kFinetuneRowNumbers>;

RowNumbers numbers_of(const FinetuneRow& row) {
  return {static_cast<double>(row.step), row.residual, row.energy, row.guards, row.synthetic_loss};
}

FinetuneRow finetune_row(const RowNumbers& n) { return {static_cast<std::int64_t>(n[0]), n[1], n[2], n[3], n[4]}; }

Curve curve_of(const std::array<std::uint8_t, 3>& colour, const auto& entries, const auto& value) {
  Curve out{.points = {}, .colour = colour};
  for (const auto& entry : entries) out.points.push_back({static_cast<double>(entry.step), value(entry)});
  return out;
}

}  // namespace

Checkpoint to_checkpoint(const FinetuneState& state) {
  std::vector<RowNumbers> rows;
  for (const FinetuneRow& row : state.rows) rows.push_back(numbers_of(row));
  std::vector<std::array<double, kScoreNumbers>> scores;
  for (const FinetuneScore& score : state.scores) {
    scores.push_back({static_cast<double>(score.step), static_cast<double>(score.people), score.residual,
                      score.untouched, score.energy, score.synthetic_rmse});
  }
  RowNumbers sum = numbers_of(state.sum);
  sum[0] = static_cast<double>(state.people_steps);
  return {.step = state.step,
          .tables = {
              {"rows", table_of(rows)}, {"scores", table_of(scores)}, {"sum", table_of(std::vector<RowNumbers>{sum})}}};
}

FinetuneState from_checkpoint(const Checkpoint& checkpoint) {
  FinetuneState state;
  state.step = checkpoint.step;
  for (const RowNumbers& numbers : rows_of<kFinetuneRowNumbers>(checkpoint.tables.at("rows")))
    state.rows.push_back(finetune_row(numbers));
  for (const auto& n : rows_of<kScoreNumbers>(checkpoint.tables.at("scores")))
    state.scores.push_back({static_cast<std::int64_t>(n[0]), static_cast<int>(n[1]), n[2], n[3], n[4], n[5]});
  for (const RowNumbers& numbers : rows_of<kFinetuneRowNumbers>(checkpoint.tables.at("sum"))) {
    state.sum = finetune_row(numbers);
    state.people_steps = std::exchange(state.sum.step, 0);
  }
  return state;
}

void add_row(FinetuneState& state) {
  const std::int64_t told = state.rows.empty() ? 0 : state.rows.back().step;
  const auto people = static_cast<double>(std::max<std::int64_t>(1, state.people_steps));
  const auto steps = static_cast<double>(std::max<std::int64_t>(1, state.step - told));
  const FinetuneRow& sum = state.sum;
  state.rows.push_back(
      {state.step, sum.residual / people, sum.energy / people, sum.guards / people, sum.synthetic_loss / steps});
  state.sum = {};
  state.people_steps = 0;
}

std::string to_csv(const std::vector<FinetuneRow>& rows) {
  std::ostringstream csv;
  csv << "step,residual,energy,guards,synthetic_loss\n";
  for (const FinetuneRow& row : rows) {
    csv << row.step << ',' << row.residual << ',' << row.energy << ',' << row.guards << ',' << row.synthetic_loss
        << '\n';
  }
  return csv.str();
}

std::string to_csv(const std::vector<FinetuneScore>& scores, double max_validation_rise) {
  std::ostringstream csv;
  csv << "step,people,residual,untouched,energy,synthetic_rmse,kept\n";
  const std::size_t kept = scores.empty() ? 0 : kept_score(scores, max_validation_rise);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const FinetuneScore& score = scores[i];
    csv << score.step << ',' << score.people << ',' << score.residual << ',' << score.untouched << ',' << score.energy
        << ',' << score.synthetic_rmse << ',' << (i == kept ? 1 : 0) << '\n';
  }
  return csv.str();
}

ByteImage draw_curves(const FinetuneState& state, bool validated) {
  const auto residual = [](const auto& entry) { return entry.residual; };
  const auto energy = [](const auto& entry) { return entry.energy; };
  std::vector<CurvePanel> panels = {
      {curve_of(kCurveBlue, state.rows, [](const FinetuneRow& row) { return row.synthetic_loss; }),
       curve_of(kCurveBlack, state.rows, energy), curve_of(kCurveRed, state.rows, residual)},
      {curve_of(kCurveBlack, state.scores, energy), curve_of(kCurveRed, state.scores, residual)}};
  if (validated) {
    panels.push_back(
        {curve_of(kCurveBlue, state.scores, [](const FinetuneScore& score) { return score.synthetic_rmse; })});
  }
  return draw_panels(panels, state.step);
}

}  // namespace faceprobe::train
