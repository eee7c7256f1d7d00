#pragma once
// Other ways than ours from a face's photo to the light: rows of every benchmark that compares lights, on synthetic photos (relight_methods.h) as on
// real ones (paper/directions.h). All start from our estimate's observations, so that only the way to the light differs.
//
//   const FaceLightMethod rival = joint_estimate(16, 0);
//   const Eigen::MatrixX3f light = rival.light({face, photo.linear});   // cells of SphereGrid(16) x 3

#include "faceprobe/pipeline/estimate.h"

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::cli {

struct FaceSeen {
  const pipeline::FaceEstimate& face;  // ours
  const Image& linear;                 // the photo it was made of, H x W x 3
};

struct FaceLightMethod {
  std::string name;
  // Cells of a sphere grid x 3, camera frame, any scale. Empty: nothing was found.
  std::function<Eigen::MatrixX3f(const FaceSeen&)> light;
  bool constant = false;  // the same light whatever the photo: that it agrees with itself says nothing
};

// `nside` below: of the grid that they fill.
// Order 2, by least squares from the shading (lighting/harmonics.h).
FaceLightMethod harmonics_of_shading(int nside);
// Knorr & Kurz, who learn from what estimates read from the training data's photos (`faceprobe trace`); nothing where that is not there. Throws
// Error(kInput) when it is of another version.
std::optional<FaceLightMethod> learnt_transfer(const std::filesystem::path& training, int nside);
// Lombardi & Nishino, lite (lighting/lombardi_nishino.h).
FaceLightMethod joint_estimate(int nside, int threads);
// One lamp where the brightest highlight's mirror direction points, and an even surround, as strong as fit the shading best. Finds nothing on a
// face without highlights.
FaceLightMethod lamp_at_brightest_highlight(int nside);
FaceLightMethod constant_light(const std::string& name, Eigen::MatrixX3f light);

// Rows, and sentences that say which are not there and why; empty when all are.
struct FaceRivals {
  std::vector<FaceLightMethod> methods = {};
  std::string missing = {};
};

}  // namespace faceprobe::cli
