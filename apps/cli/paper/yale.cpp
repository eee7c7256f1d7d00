#include "paper/yale.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/largest_face.h"
#include "paper/csv.h"
#include "paper/light_direction.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <utility>

namespace faceprobe::cli {

namespace {

constexpr std::array<double, 5> kSubsetEdgesDeg = {0, 12, 25, 50, kYaleMaxAxisDeg};  // Georghiades et al. 2001, section 5

// Each subset has its upper edge: 25 degrees are of the second.
std::size_t subset_of(double axis_deg) {
  constexpr double kRounding_deg = 1e-6;
  std::size_t subset = 0;
  while (subset + 2 < kSubsetEdgesDeg.size() && axis_deg > kSubsetEdgesDeg[subset + 1] + kRounding_deg) ++subset;
  return subset;
}

double angle_in(const std::string& text, const std::filesystem::path& table) {
  char* end = nullptr;
  const double angle = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !std::isfinite(angle))
    throw Error(ExitCode::kInput, table.string() + " has '" + text + "' for an angle; it takes degrees.");
  return angle;
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

using FlashMetrics = std::map<std::string, double>;

constexpr double kNoAnswer = std::numeric_limits<double>::quiet_NaN();

double error_deg(const std::optional<Eigen::Vector3d>& direction, const Eigen::Vector3d& light) {
  return direction ? angle_between_deg(*direction, light) : kNoAnswer;
}

FlashMetrics light_errors(const pipeline::LightResult& result, const Eigen::Vector3d& light) {
  const std::vector<Eigen::Vector3d> lights = light_directions(result);
  return {{"main_light_deg", lights.empty() ? kNoAnswer : angle_between_deg(lights.front(), light)},
          {"centroid_deg", error_deg(energy_centroid(result), light)}};
}

FlashMetrics flash_errors(const std::optional<pipeline::FaceEstimate>& face, const Eigen::Vector3d& light) {
  if (!face) return {{"main_light_deg", kNoAnswer}, {"centroid_deg", kNoAnswer}, {"lamp_deg", kNoAnswer}, {"face", 0}};
  FlashMetrics metrics = light_errors(*face, light);
  metrics["lamp_deg"] = error_deg(single_lamp(face->observations), light);
  metrics["face"] = 1;
  return metrics;
}

FlashMetrics rival_errors(const FaceLightMethod& rival, const std::optional<pipeline::FaceEstimate>& face,
                          const io::Photo& photo, const Eigen::Vector3d& light) {
  Eigen::MatrixX3f found = face ? rival.light({*face, photo.linear}) : Eigen::MatrixX3f();
  if (found.size() == 0) return {{"main_light_deg", kNoAnswer}, {"centroid_deg", kNoAnswer}};
  return light_errors(result_of(std::move(found)), light);
}

}  // namespace

std::vector<std::string> yale_flash_labels() {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i + 1 < kSubsetEdgesDeg.size(); ++i) {
    labels.push_back(std::to_string(std::lround(kSubsetEdgesDeg[i])) + " - " +
                     std::to_string(std::lround(kSubsetEdgesDeg[i + 1])));
  }
  return labels;
}

std::vector<YalePicture> yale_pictures(const std::filesystem::path& folder, int every) {
  const CsvTable table = read_csv(folder / "lights.csv");
  const std::size_t file = table.column("file");
  const std::size_t subject = table.column("subject");
  const std::size_t azimuth = table.column("azimuth_deg");
  const std::size_t elevation = table.column("elevation_deg");
  std::vector<YalePicture> pictures;
  int usable = 0;
  for (const auto& row : table.rows) {
    // The database counts azimuth towards the subject's right, which is image left.
    const Eigen::Vector3d light = direction_from_angles(-angle_in(row[azimuth], folder / "lights.csv"),
                                                        angle_in(row[elevation], folder / "lights.csv"));
    const double axis = angle_between_deg(light, Eigen::Vector3d::UnitZ());
    const auto path = folder / "images" / row[file];
    if (axis > kYaleMaxAxisDeg || !std::filesystem::exists(path)) continue;
    if (usable++ % every == 0) pictures.push_back({path.stem().string(), path, light, axis, row[subject]});
  }
  return pictures;
}

eval::ScoreTable measure_yale(const std::vector<YalePicture>& pictures, const std::vector<DirectionSetting>& settings,
                              const PhotoDone& done, const std::vector<FaceLightMethod>& rivals) {
  std::vector<DirectionSetting> aligned = settings;
  for (DirectionSetting& setting : aligned) setting.options.landmarks_px = fixed_landmarks();
  const std::vector<pipeline::Estimator> estimators = estimators_of(aligned);
  const std::vector<std::string> labels = yale_flash_labels();
  eval::ScoreTable scores;
  scores.order_labels("flash", labels);
  for (const YalePicture& picture : pictures) {
    const auto add = [&](const std::string& name, const FlashMetrics& metrics) {
      scores.add({name, picture.name, {{"flash", labels[subset_of(picture.axis_deg)]}}, metrics, picture.subject});
    };
    add(kStraightAhead, {{"main_light_deg", picture.axis_deg}, {"centroid_deg", picture.axis_deg}});
    const io::Photo as_srgb = io::load_photo(picture.file);
    const io::Photo as_light = as_linear_codes(as_srgb);
    for (std::size_t k = 0; k < aligned.size(); ++k) {
      const io::Photo& photo = aligned[k].linear_codes ? as_light : as_srgb;
      const std::optional<pipeline::FaceEstimate> face = pipeline::find_largest_face(estimators[k], photo);
      add(aligned[k].name, flash_errors(face, picture.light));
      if (k > 0) continue;
      for (const FaceLightMethod& rival : rivals) add(rival.name, rival_errors(rival, face, photo, picture.light));
    }
    if (done) done();
  }
  return scores;
}

}  // namespace faceprobe::cli
