#include "direction/direction.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/estimate.h"
#include "support/csv.h"
#include "support/light_direction.h"
#include "support/photos.h"
#include "support/statistics.h"

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::bench {

namespace {

constexpr double kMaxAxisDeg = 77;  // subsets 1 to 4 of the database; beyond, most of the face is black
constexpr std::array<double, 5> kSubsetEdges_deg = {0, 12, 25, 50, kMaxAxisDeg};  // Georghiades et al. 2001, section 5

struct Picture {
  std::filesystem::path file;
  Eigen::Vector3d light;
  double axis_deg = 0;  // from the camera axis
};

std::vector<Picture> pictures_of(const std::filesystem::path& folder) {
  const CsvTable table = read_csv(folder / "lights.csv");
  const std::size_t file = table.column("file");
  const std::size_t azimuth = table.column("azimuth_deg");
  const std::size_t elevation = table.column("elevation_deg");
  std::vector<Picture> pictures;
  for (const auto& row : table.rows) {
    // The database counts azimuth towards the subject's right, which is image left.
    const Eigen::Vector3d light = direction_from_angles(-std::stod(row[azimuth]), std::stod(row[elevation]));
    const double axis = angle_between_deg(light, Eigen::Vector3d::UnitZ());
    const auto path = folder / "images" / row[file];
    if (axis <= kMaxAxisDeg && std::filesystem::exists(path)) pictures.push_back({path, light, axis});
  }
  return pictures;
}

// Eyes, nose tip, mouth corners: the same in every picture of the cropped set, for its pictures are aligned.
Eigen::MatrixX2f fixed_landmarks() {
  Eigen::MatrixX2f points(5, 2);
  points << 34.4F, 46.6F, 132.2F, 45.4F, 79.1F, 100.2F, 43.9F, 152.3F, 121.3F, 152.8F;
  return points;
}

// The database's readme: the camera had a linear response. The files carry no profile, so the loader took them for sRGB; this
// undoes its curve.
io::Photo as_linear_codes(io::Photo photo) {
  for (float& value : photo.linear.values()) value = srgb_from_linear(value);
  return photo;
}

struct Row {
  std::string name;
  std::vector<double> error_deg;
  std::vector<double> axis_deg;

  void add(const Picture& picture, const std::optional<Eigen::Vector3d>& direction) {
    if (!direction) return;
    error_deg.push_back(angle_between_deg(*direction, picture.light));
    axis_deg.push_back(picture.axis_deg);
  }
  std::vector<double> between(double low_deg, double high_deg) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < error_deg.size(); ++i) {
      if (axis_deg[i] >= low_deg && axis_deg[i] < high_deg) errors.push_back(error_deg[i]);
    }
    return errors;
  }
};

void print(const std::vector<Row>& rows, std::size_t pictures) {
  std::printf("| estimate | answers | mean | median | 90 %% | < 15 | < 30 |");
  for (std::size_t i = 0; i + 1 < kSubsetEdges_deg.size(); ++i) {
    std::printf(" median at %.0f - %.0f |", kSubsetEdges_deg[i], kSubsetEdges_deg[i + 1]);
  }
  std::printf("\n| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Row& row : rows) {
    // Shares are of all pictures: no answer is no good answer.
    const auto share = [&](double limit_deg) {
      const double good = row.error_deg.empty() ? 0 : share_below(row.error_deg, limit_deg);
      return cell(100 * good * static_cast<double>(row.error_deg.size()) / static_cast<double>(pictures), 0);
    };
    std::printf("| %s | %zu | %s | %s | %s | %s %% | %s %% |", row.name.c_str(), row.error_deg.size(),
                cell(mean(row.error_deg)).c_str(), cell(median(row.error_deg)).c_str(),
                cell(quantile(row.error_deg, 0.9)).c_str(), share(15).c_str(), share(30).c_str());
    for (std::size_t i = 0; i + 1 < kSubsetEdges_deg.size(); ++i) {
      const double high_deg = i + 2 < kSubsetEdges_deg.size() ? kSubsetEdges_deg[i + 1] : 180;
      std::printf(" %s |", cell(median(row.between(kSubsetEdges_deg[i], high_deg))).c_str());
    }
    std::printf("\n");
  }
}

struct Setting {
  lighting::Solver solver;
  std::optional<highlight::Separator> classical;
  bool linear;
  std::string name;
  pipeline::PriorSource prior = pipeline::PriorSource::kNet;
};

}  // namespace

void report_yale(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base) {
  const std::vector<Picture> pictures = every_nth(pictures_of(folder), every);
  Row straight{"straight ahead, no estimate", {}, {}};
  for (const Picture& picture : pictures) straight.add(picture, Eigen::Vector3d::UnitZ());
  std::vector<Row> rows = {straight};
  int faceless = 0;
  for (const Setting& setting :
       {Setting{lighting::Solver::kTransport, {}, true, "transport, net"},
        Setting{lighting::Solver::kTransport, highlight::Separator::kYang, true, "transport, classical"},
        Setting{
            lighting::Solver::kTransport, {}, true, "transport, net, without the prior", pipeline::PriorSource::kSmooth},
        Setting{lighting::Solver::kPaper, {}, true, "paper, net"},
        Setting{lighting::Solver::kTransport, {}, false, "transport, net, codes taken for sRGB"}}) {
    pipeline::EstimateOptions options = base;
    options.solve.solver = setting.solver;
    options.classical = setting.classical;
    options.prior = setting.prior;
    options.landmarks_px = fixed_landmarks();
    const pipeline::Estimator estimator(options);
    Row lamp{"single lamp by least squares" + std::string(setting.linear ? "" : ", codes taken for sRGB"), {}, {}};
    Row main_light{setting.name + ": main light", {}, {}};
    Row centroid{setting.name + ": energy centroid", {}, {}};
    for (const Picture& picture : pictures) {
      io::Photo photo = io::load_photo(picture.file);
      if (setting.linear) photo = as_linear_codes(std::move(photo));
      try {
        const pipeline::Estimate estimate = estimator.estimate(photo);
        const pipeline::FaceEstimate& face = estimate.faces[estimate.largest];
        const std::vector<Eigen::Vector3d> lights = light_directions(face);
        if (!lights.empty()) main_light.add(picture, lights.front());
        centroid.add(picture, energy_centroid(face));
        lamp.add(picture, single_lamp(face.observations));
      } catch (const Error& error) {
        if (error.code() != ExitCode::kNoFace) throw;
        ++faceless;
      }
    }
    if (setting.classical || !setting.linear) rows.push_back(std::move(lamp));
    rows.push_back(std::move(main_light));
    rows.push_back(std::move(centroid));
  }
  std::printf(
      "### Yale B: one flash\n\nAngles in degrees between the estimate and the flash, %zu pictures with the flash up to"
      " %.0f degrees off the camera axis; the last columns by that angle. The pictures are grey, so"
      " the classical separators find no highlights and all three give the same. Their code values are taken for "
      "linear light unless the row says otherwise. Estimates that "
      "found"
      " no face: %d.\n\n",
      pictures.size(), kMaxAxisDeg, faceless);
  print(rows, pictures.size());
}

}  // namespace faceprobe::bench
