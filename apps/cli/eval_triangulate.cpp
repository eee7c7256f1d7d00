#include "eval_stages.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/room_benchmark.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/room.h"

#include <spdlog/fmt/fmt.h>

#include <array>

namespace faceprobe::cli {

namespace {

// Corners of both eyes in the dense mesh.
constexpr std::array<int, 4> kEyeCorners = {33, 133, 362, 263};

Eigen::Vector3d between_eyes(const face::Face& face) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int corner : kEyeCorners) sum += face.vertices_cam_m.row(corner).transpose().cast<double>();
  return sum / static_cast<double>(kEyeCorners.size());
}

eval::LookAtGroup estimate_of(const EvalOptions& options) {
  pipeline::EstimateOptions wanted;
  if (!options.weights.empty()) wanted.weights = name_and_file(options.weights[0]).second;
  wanted.prior_weights = options.prior;
  wanted.finder.min_face_px = face::kSmallFacePx;
  wanted.threads = options.threads;
  return [wanted](const eval::PhotoInput& input) {
    // The camera's focal length is known, as from EXIF: without it all distances are off by its error.
    pipeline::EstimateOptions with_camera = wanted;
    with_camera.focal_px = input.camera.focal_px;
    const pipeline::Estimator estimator(with_camera);
    std::vector<lighting::FaceLights> faces;
    try {
      const pipeline::Estimate estimate = estimator.estimate(io::photo_from_srgb(input.photo));
      if (estimate.faces.size() < 2) {  // no lamp can be placed, but the face was found
        faces.resize(estimate.faces.size());
      } else {
        faces = pipeline::find_lamps(estimate).faces;
      }
      for (std::size_t i = 0; i < faces.size(); ++i) faces[i].position_m = between_eyes(estimate.faces[i].face);
    } catch (const Error& error) {
      if (error.code() != ExitCode::kNoFace) throw;
    }
    return faces;
  };
}

}  // namespace

eval::ScoreTable measure_lamps(const synth::ShardReader& groups, const EvalOptions& options,
                               const std::function<void(int, int)>& progress) {
  return eval::measure_rooms(groups, estimate_of(options),
                             {.samples = options.samples, .triangulate = {}, .progress = progress});
}

int eval_triangulate(const EvalOptions& options) {
  const synth::ShardReader groups(options.data);
  const eval::ScoreTable table = measure_lamps(groups, options, eval_progress());
  fmt::print("Up to {} photos of {}.\n", options.samples, options.data);
  fmt::print("\n### Share of the faces that were found\n\n{}", table.markdown("face_found", 2));
  fmt::print("\n### Faces, metres from where they are\n\n{}", table.markdown("face_m", 2));
  if (table.metrics().contains("found")) {
    fmt::print("\n### Lamps, metres from where they are; missing = not found\n\n{}", table.markdown("lamp_m", 2));
    fmt::print("\n### Share of the lamps that were found\n\n{}", table.markdown("found", 2));
    fmt::print("\n### Share of the lamps that were found within .4 m\n\n{}", table.markdown("within", 2));
    fmt::print("\n### Share of found lamps inside the ellipsoid that is stated for 95 %\n\n{}",
               table.markdown("covered", 2));
  } else {
    fmt::print("\nNo photo has a near lamp: all that are found are invented.\n");
  }
  fmt::print("\n### Lamps a photo that are not there\n\n{}", table.markdown("invented", 2));
  fmt::print("\n### Share of the photos with such a lamp\n\n{}", table.markdown("inventing", 2));
  if (options.output.empty()) return 0;
  const std::filesystem::path folder = options.output;
  io::create_folder(folder);
  io::write_file_atomically(folder / "triangulate.csv", table.csv());
  io::write_file_atomically(folder / "triangulate.json", table.json());
  return 0;
}

}  // namespace faceprobe::cli
