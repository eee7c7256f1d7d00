#include "train/train_log.h"

#include "train/curves.h"
#include "train/table.h"

#include <array>
#include <cstdio>

namespace faceprobe::train {
namespace {

constexpr std::size_t kTrainRowNumbers = 14;

}  // namespace

torch::Tensor table_of_rows(const std::vector<TrainRow>& rows) {
  std::vector<std::array<double, kTrainRowNumbers>> numbers;
  for (const TrainRow& row : rows) {
    const Validation& found = row.validation;
    numbers.push_back({static_cast<double>(row.step), row.loss, row.learning_rate, row.samples_per_second,
                       row.validated ? 1.0 : 0.0, found.skin, found.whole, found.black_skin, found.black_whole,
                       found.normal_deg, found.region_share, found.shading, found.colour_deg, found.open_shading});
  }
  return table_of(numbers);
}

std::vector<TrainRow> rows_of_table(const torch::Tensor& table) {
  std::vector<TrainRow> rows;
  for (const auto& n : rows_of<kTrainRowNumbers>(table)) {
    TrainRow row;
    row.step = static_cast<std::int64_t>(n[0]);
    row.loss = n[1];
    row.learning_rate = n[2];
    row.samples_per_second = n[3];
    row.validated = n[4] != 0;
    row.validation = {n[5], n[6], n[7], n[8], n[9], n[10], n[11], n[12], n[13]};
    rows.push_back(row);
  }
  return rows;
}

std::string to_csv(const std::vector<TrainRow>& rows) {
  std::string csv =
      "step,loss,learning_rate,samples_per_second,rmse_skin,rmse_whole,black_skin,black_whole,normal_deg,region_share,"
      "shading,colour_deg,open_shading\n";
  std::array<char, 256> line{};
  for (const TrainRow& row : rows) {
    std::snprintf(line.data(), line.size(), "%lld,%.6g,%.6g,%.2f", static_cast<long long>(row.step), row.loss,
                  row.learning_rate, row.samples_per_second);
    csv += line.data();
    if (row.validated) {
      std::snprintf(line.data(), line.size(), ",%.4f,%.4f,%.4f,%.4f,%.3f,%.4f,%.4f,%.3f,%.4f", row.validation.skin,
                    row.validation.whole, row.validation.black_skin, row.validation.black_whole,
                    row.validation.normal_deg, row.validation.region_share, row.validation.shading,
                    row.validation.colour_deg, row.validation.open_shading);
      csv += line.data();
    } else {
      csv += ",,,,,,,,,";
    }
    csv += '\n';
  }
  return csv;
}

ByteImage draw_curves(const std::vector<TrainRow>& rows) {
  Curve loss{.points = {}, .colour = kCurveBlack};
  Curve skin{.points = {}, .colour = kCurveRed};
  Curve whole{.points = {}, .colour = kCurveBlue};
  for (const TrainRow& row : rows) {
    const auto step = static_cast<double>(row.step);
    loss.points.push_back({step, row.loss});
    if (!row.validated) continue;
    skin.points.push_back({step, row.validation.skin});
    whole.points.push_back({step, row.validation.whole});
  }
  return draw_panels({{loss}, {whole, skin}}, rows.empty() ? 0 : rows.back().step);
}

}  // namespace faceprobe::train
