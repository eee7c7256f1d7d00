#pragma once
// The estimate as JSON, for scripts. The schema is versioned: fields are added, never renamed or dropped, within "faceprobe-report/1".
// Lengths in metres, angles in degrees with `_deg`, pixels with `_px`; directions in the camera frame, from the face to the light.
//
//   io::write_file_atomically("report.json", report_json(estimate, photo, estimator.options(), "portrait.jpg"));

#include "faceprobe/pipeline/estimate.h"

#include <string>
#include <string_view>

namespace faceprobe::pipeline {

inline constexpr std::string_view kReportSchema = "faceprobe-report/1";

// One object, UTF-8, indented, ends in a line break. `source` is what the user called the photo.
std::string report_json(const Estimate& estimate, const io::Photo& photo, const EstimateOptions& options,
                        const std::string& source);

}  // namespace faceprobe::pipeline
