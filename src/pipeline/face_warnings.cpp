#include "pipeline/face_warnings.h"

namespace faceprobe::pipeline {

Error no_face(const io::Photo& photo, const EstimateOptions& options) {
  return {ExitCode::kNoFace, "No face was found in this picture of " + std::to_string(photo.linear.width()) + " x " +
                                 std::to_string(photo.linear.height()) + " px; faces are looked for from " +
                                 std::to_string(options.finder.min_face_px) +
                                 " px. If there is one, give its landmarks."};
}

std::optional<std::string> no_highlights_warning(const FaceEstimate& face, lighting::Solver solver) {
  if (lighting::shows_highlights(face.observations)) return std::nullopt;
  const std::string who =
      "A face " + std::to_string(static_cast<int>(face.face.box.width)) + " px wide shows no highlights";
  if (solver == lighting::Solver::kTransport)
    return who + "; its light comes from shading alone, which tells where lamps are but not how small.";
  const bool black = face.light.radiance.size() == 0 || !(face.light.radiance.maxCoeff() > 0);
  return who + " and the paper's solver reads nothing else, so its map is " +
         (black ? "black." : "made of what little there is; do not rely on it.");
}

}  // namespace faceprobe::pipeline
