#include "pipeline/expected_light.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/lighting/face_features.h"

#include <algorithm>

namespace faceprobe::pipeline {

namespace {

// The same brightness in broad colours: of these the prior knows a blue sky over a brown ground; cell by cell they are noise, and where no skin
// looks the noise would stay. Behind the head they are half guesses: on synthetic photos nothing is lost there when they go halfway (as
// logarithms) to the colour of the light from the front.
Eigen::MatrixX3f broadly_coloured(const Eigen::MatrixX3f& light, const SphereGrid& grid) {
  const SphereGrid broad(2);  // cells of 29 degrees
  Eigen::MatrixX3f out = grid_from_grid(grid_from_grid(light, grid, broad), broad, grid);
  const Eigen::VectorXf scale = (light * kLuminanceWeights).array() / (out * kLuminanceWeights).array().max(1e-9F);
  for (Eigen::Index j = 0; j < out.rows(); ++j) out.row(j) *= scale[j];
  const Eigen::VectorXf depth = grid.directions().col(2);
  const Eigen::RowVector3f front = depth.cwiseMax(0.0F).transpose() * out;
  const float front_luminance = front * kLuminanceWeights;
  if (!(front.minCoeff() > 0)) return out;
  for (Eigen::Index j = 0; j < out.rows(); ++j) {
    const float luminance = out.row(j) * kLuminanceWeights;
    const float kept = 0.75F + 0.25F * depth[j];
    const Eigen::RowVector3f colour = (out.row(j) / std::max(1e-9F, luminance)).array().max(1e-6F).pow(kept) *
                                      (front / front_luminance).array().pow(1.0F - kept);
    out.row(j) = colour * (luminance / (colour * kLuminanceWeights).value());
  }
  return out;
}

}  // namespace

std::optional<net::LightPrior> load_prior(const EstimateOptions& options) {
  if (!options.asks_prior()) return std::nullopt;
  const std::filesystem::path path =
      options.prior_weights.empty() ? io::data_file("light.safetensors") : options.prior_weights;
  net::LightPrior prior(path);
  if (prior.inputs() != lighting::kFaceFeatures) {
    throw Error(ExitCode::kModel, "The light prior in " + path.string() + " wants " + std::to_string(prior.inputs()) +
                                      " features; faces have " + std::to_string(lighting::kFaceFeatures) +
                                      ". Use weights made for this version.");
  }
  return prior;
}

Eigen::MatrixX3f expected_light(const net::LightPrior& prior, const lighting::Observations& observations, int nside) {
  if (!(lighting::shading_level(observations) > 0)) return {};
  const Eigen::VectorXf features = lighting::face_features(observations);
  const Eigen::MatrixX3f light = prior.radiance(features);
  const Eigen::MatrixX3f other = lighting::mirrored_cells(prior.radiance(lighting::mirrored_features(features)));
  const Eigen::MatrixX3f mean = light.cwiseProduct(other).cwiseSqrt();
  const SphereGrid coarse(lighting::kFeatureNside);
  return grid_from_grid(broadly_coloured(mean, coarse), coarse, SphereGrid(nside));
}

}  // namespace faceprobe::pipeline
