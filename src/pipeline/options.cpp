#include "faceprobe/pipeline/estimate.h"

#include <Eigen/Eigenvalues>

namespace faceprobe::pipeline {

namespace {

// Eyes, nose and mouth fill an area: the thinner axis of their spread is about the size of the other. A profile still has a fifth.
bool spread_out(const Eigen::MatrixX2f& points) {
  if (!points.allFinite()) return false;
  const Eigen::MatrixX2f centred = points.rowwise() - points.colwise().mean();
  const Eigen::Matrix2f covariance = centred.transpose() * centred;
  const Eigen::Vector2f axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2f>(covariance).eigenvalues();
  return axes[1] > 0 && axes[0] > 0.0025F * axes[1];  // a twentieth in length
}

}  // namespace

std::string EstimateOptions::validate() const {
  for (const std::string& fault : {finder.validate(), solve.validate(), main_lights.validate()}) {
    if (!fault.empty()) return fault;
  }
  if (focal_px && !(*focal_px > 1.0 && *focal_px < 1e7)) {
    return "The focal length must be from 1 to 10 million pixels, found " + std::to_string(*focal_px) + ".";
  }
  if (layer_px < 64 || layer_px > 8192)
    return "layer_px must be from 64 to 8192, found " + std::to_string(layer_px) + ".";
  if (max_patches < 50 || max_patches > 20'000) {
    return "max_patches must be from 50 to 20000, found " + std::to_string(max_patches) + ".";
  }
  if (map_width < 16 || map_width > 4096 || map_width % 4 != 0) {
    return "The map's width must be a multiple of 4 from 16 to 4096, found " + std::to_string(map_width) + ".";
  }
  if (!(least_shown >= 0 && least_shown <= 1))
    return "least_shown must be from 0 to 1, found " + std::to_string(least_shown) + ".";
  if (sh_order < 0 || sh_order > 10) return "sh_order must be from 0 to 10, found " + std::to_string(sh_order) + ".";
  if (normals == NormalSource::kFit && !surface_fit)
    return "Normals of a fitted head model need the model; set surface_fit, such as pipeline::head_geometry().";
  if (shading == ShadingSource::kGiven && !shading_split)
    return "Shading that is given needs who gives it; set shading_split, such as layers() of a net::TorchShadingNet.";
  if (landmarks_px && landmarks_px->rows() != 5 && landmarks_px->rows() != 68) {
    return "Give 5 or 68 landmarks, found " + std::to_string(landmarks_px->rows()) + ".";
  }
  if (landmarks_px && !spread_out(*landmarks_px)) {
    return "The landmarks lie on a line or on one point; a face's do not.";
  }
  return {};
}

bool EstimateOptions::asks_prior() const {
  return prior == PriorSource::kNet && !classical && solve.solver == lighting::Solver::kTransport;
}

std::string EstimateOptions::separator_name() const {
  return classical ? std::string(highlight::separator_name(*classical)) : "net";
}

}  // namespace faceprobe::pipeline
