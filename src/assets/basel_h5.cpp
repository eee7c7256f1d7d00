#include "assets/basel.h"

#include "assets/array.h"
#include "assets/finish_head.h"
#include "assets/hdf5_file.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace faceprobe::assets {
namespace {

constexpr float kMetresPerMillimetre = 1e-3F;

// One of the file's three statistics: "shape", "color" or "expression". As statismo writes them, mean and pcaBasis hold x, y, z (or
// r, g, b) of the vertices in turn; the columns of pcaBasis are of unit length and pcaVariance holds variances.
struct Statistics {
  Eigen::MatrixX3f mean;
  std::vector<Eigen::MatrixX3f> modes;  // one standard deviation each
};

Statistics read_statistics(const Hdf5File& file, const std::string& group, float scale, std::size_t wanted) {
  const Array mean = file.array(group + "/model/mean");
  const Array basis = file.array(group + "/model/pcaBasis");
  const Array variance = file.array(group + "/model/pcaVariance");
  const std::size_t rows = mean.values.size();
  if (wanted != 0 && rows != wanted) {
    refuse_input(file.name() + ": '" + group + "/model/mean' holds " + std::to_string(rows) + " numbers; " +
                 std::to_string(wanted) + " are needed, as for the shape.");
  }
  const std::size_t columns = variance.values.size();
  if (basis.shape != std::vector<std::size_t>{rows, columns}) {
    refuse_input(file.name() + ": '" + group + "/model/pcaBasis' is " + shape_text(basis.shape) + "; " +
                 std::to_string(rows) + " x " + std::to_string(columns) + " is needed.");
  }
  Statistics statistics{rows_of_3(mean, file.name() + ": the mean of " + group) * scale, {}};
  for (std::size_t k = 0; k < columns; ++k) {
    if (!(variance.values[k] >= 0)) {
      refuse_input(file.name() + ": '" + group + "/model/pcaVariance' holds " + std::to_string(variance.values[k]) +
                   ", not a variance.");
    }
    const float deviation = scale * std::sqrt(variance.values[k]);
    Eigen::MatrixX3f mode(static_cast<Eigen::Index>(rows / 3), 3);
    for (std::size_t i = 0; i < rows; ++i) {
      mode(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) =
          deviation * basis.values[i * columns + k];
    }
    statistics.modes.push_back(std::move(mode));
  }
  return statistics;
}

// The file has its cells 3 x T, each row one corner; T x 3 is taken as well.
Eigen::MatrixX3i read_cells(const Hdf5File& file, Eigen::Index vertices) {
  const Array cells = file.array("shape/representer/cells");
  const std::string what = file.name() + ": 'shape/representer/cells'";
  if (cells.shape.size() != 2 || (cells.shape[0] != 3 && cells.shape[1] != 3)) {
    refuse_input(what + " is " + shape_text(cells.shape) + "; 3 x the number of triangles is needed.");
  }
  const bool by_corner = cells.shape[0] == 3;
  const Eigen::MatrixXi rows = integer_rows(cells, static_cast<Eigen::Index>(cells.shape[1]), what);
  Eigen::MatrixX3i triangles = by_corner ? Eigen::MatrixX3i(rows.transpose()) : Eigen::MatrixX3i(rows);
  if (triangles.minCoeff() < 0 || triangles.maxCoeff() >= vertices) {
    refuse_input(what + " names vertices outside 0 .. " + std::to_string(vertices - 1) + ".");
  }
  return triangles;
}

// metadata/landmarks/json: a list of {"id": name, "coordinates": [x, y, z]} in the file's units. Taken as the 68 points when their
// names are "0" .. "67" (other sets of names do not say which they are in Multi-PIE's order).
void read_landmarks(const Hdf5File& file, synth::HeadModel& model) {
  const std::string text = file.text("metadata/landmarks/json");
  if (text.empty()) return;
  std::array<std::optional<Eigen::RowVector3f>, 68> points;
  try {
    for (const nlohmann::json& mark : nlohmann::json::parse(text)) {
      const std::string id = mark.at("id").get<std::string>();
      if (id.empty() || id.size() > 2 || id.find_first_not_of("0123456789") != std::string::npos || std::stoi(id) > 67)
        continue;
      const auto at = mark.at("coordinates").get<std::array<float, 3>>();
      points[static_cast<std::size_t>(std::stoi(id))] = Eigen::RowVector3f(at[0], at[1], at[2]) * kMetresPerMillimetre;
    }
  } catch (const nlohmann::json::exception& fault) {
    refuse_input(file.name() + ": 'metadata/landmarks/json' is not a list of landmarks: " + fault.what() + ".");
  }
  std::vector<int> vertices;
  for (const auto& point : points) {
    if (!point.has_value()) return;
    Eigen::Index nearest = 0;
    (model.neutral.rowwise() - *point).rowwise().squaredNorm().minCoeff(&nearest);
    vertices.push_back(static_cast<int>(nearest));
  }
  model.landmarks = vertices;
}

}  // namespace

synth::HeadModel read_basel_h5(const std::filesystem::path& path) {
  const Hdf5File file(path);
  if (!file.has("shape/model/mean")) {
    refuse_input(file.name() + " holds no 'shape/model/mean': it is not a Basel Face Model of 2017 or 2019 (.h5).");
  }
  synth::HeadModel model;
  model.name = path.stem().string();
  Statistics shape = read_statistics(file, "shape", kMetresPerMillimetre, 0);
  model.neutral = std::move(shape.mean);
  model.identity = std::move(shape.modes);
  const auto numbers = static_cast<std::size_t>(model.neutral.size());
  if (file.has("expression/model/mean")) {
    Statistics expression = read_statistics(file, "expression", kMetresPerMillimetre, numbers);
    model.neutral += expression.mean;
    model.expression = std::move(expression.modes);  // statistics, without names
  }
  model.triangles = read_cells(file, model.neutral.rows());
  if (file.has("color/model/mean")) {
    Statistics colour = read_statistics(file, "color", 1.0F, numbers);
    set_encoded_albedo(model, std::move(colour.mean));
    for (Eigen::MatrixX3f& mode : colour.modes) add_encoded_albedo_mode(model, std::move(mode));
    finish_albedo(model);
  }
  read_landmarks(file, model);
  return model;
}

}  // namespace faceprobe::assets
