#pragma once
// Extended Yale B: real faces, each under one flash whose direction the database gives. The pictures are grey, aligned and cropped, so landmarks
// are given and the classical separators find no highlights: all three give the same.
//
//   const std::vector<YalePicture> pictures = yale_pictures(data / "real" / "yaleB", 3);
//   const eval::ScoreTable scores = measure_yale(pictures, {direction_setting(lighting::Solver::kTransport, {}, {})});
//   std::cout << scores.markdown_by_group("main_light_deg", "flash", 1);

#include "face_light_methods.h"
#include "faceprobe/eval/score_table.h"
#include "paper/direction_setting.h"

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::cli {

// Subsets 1 to 4 of the database, by the flash's angle off the camera axis; beyond, most of the face is black.
inline constexpr double kYaleMaxAxisDeg = 77;
// Their angles, as labels of the group "flash".
std::vector<std::string> yale_flash_labels();

struct YalePicture {
  std::string name;
  std::filesystem::path file;
  Eigen::Vector3d light;  // unit, camera frame
  double axis_deg = 0;    // from the camera axis
  std::string subject;    // whom it shows
};
// Every n-th of those whose file is there. Throws Error(kInput) for a table that cannot be read.
std::vector<YalePicture> yale_pictures(const std::filesystem::path& folder, int every);

// A row a picture and setting, and one of a light straight ahead, which is what no look at the photo gives. Metrics, degrees from the flash:
// main_light_deg, centroid_deg (of the light's energy), lamp_deg (the single lamp that fits the shading best); NaN where there is no such answer.
// face: 1, or 0 where none was found. Group: flash. Rows say whom they show, so intervals draw subjects. The settings' landmarks are replaced.
// Rivals are given the first setting's estimates, and have neither lamp_deg nor face.
eval::ScoreTable measure_yale(const std::vector<YalePicture>& pictures, const std::vector<DirectionSetting>& settings,
                              const PhotoDone& done = {}, const std::vector<FaceLightMethod>& rivals = {});

}  // namespace faceprobe::cli
