#pragma once
// The estimate as JSON, for scripts. The schema is versioned: fields are added, never renamed or dropped, within "faceprobe-report/1".
// Lengths in metres, angles in degrees with `_deg`, pixels with `_px`; directions in the camera frame, from the face to the light.
//
//   io::write_file_atomically("report.json", report_json(estimate, photo, estimator.options(), "portrait.jpg"));

#include "faceprobe/pipeline/estimate.h"

#include <string>
#include <string_view>
#include <vector>

namespace faceprobe::pipeline {

inline constexpr std::string_view kReportSchema = "faceprobe-report/1";

// One object, UTF-8, indented, ends in a line break. `source` is what the user called the photo.
std::string report_json(const Estimate& estimate, const io::Photo& photo, const EstimateOptions& options,
                        const std::string& source);

inline constexpr std::string_view kJointReportSchema = "faceprobe-joint-report/1";

// A photo whose faces took part in one light, Estimator::joint().
struct JointPhoto {
  std::string source;     // what the user called it
  std::string sha256;     // io::Photo::sha256
  std::size_t faces = 0;  // of it that took part
};
// The light of several photos and what it was read from; form as above, schema kJointReportSchema.
std::string joint_report_json(const LightResult& light, const std::vector<JointPhoto>& photos,
                              const EstimateOptions& options);

}  // namespace faceprobe::pipeline
