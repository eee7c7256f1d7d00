#include "face_light_methods.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/lighting/face_features.h"
#include "faceprobe/lighting/harmonics.h"
#include "faceprobe/lighting/lombardi_nishino.h"
#include "faceprobe/lighting/radiance_transfer.h"
#include "faceprobe/synth/traced.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace faceprobe::cli {

namespace {

Eigen::MatrixX3f brightest_spot(const lighting::Observations& o, const SphereGrid& grid) {
  Eigen::Index spot = 0;
  if (o.count() == 0 || !(o.highlight.rowwise().sum().maxCoeff(&spot) > 0)) return {};
  const Eigen::RowVector3f normal = o.normal.row(spot);
  const Eigen::RowVector3f mirrored = 2 * normal.dot(o.view.row(spot)) * normal - o.view.row(spot);
  Eigen::Matrix2f products = Eigen::Matrix2f::Identity() * 1e-6F;
  Eigen::Matrix<float, 2, 3> right = Eigen::Matrix<float, 2, 3>::Zero();
  for (Eigen::Index i = 0; i < o.count(); ++i) {
    const Eigen::Vector2f row(1, std::max(0.0F, o.normal.row(i).dot(mirrored)));
    products += o.weight[i] * row * row.transpose();
    right += o.weight[i] * row * o.shading.row(i);
  }
  const Eigen::Matrix<float, 2, 3> fit = products.inverse() * right;
  Eigen::MatrixX3f light(grid.cell_count(), 3);
  light.rowwise() = fit.row(0).cwiseMax(0.0F);
  // A lamp of one cell whose irradiance over pi is the fit's.
  const auto cell_over_pi = static_cast<float>(grid.cell_solid_angle() / kPi);
  light.row(grid.cell_of(mirrored.transpose())) += fit.row(1).cwiseMax(0.0F) / cell_over_pi;
  return light;
}

}  // namespace

FaceLightMethod harmonics_of_shading(int nside) {
  return {"harmonics of order 2 from the shading", [grid = std::make_shared<SphereGrid>(nside)](const FaceSeen& seen) {
            return lighting::radiance_of_harmonics(lighting::fit_harmonics(seen.face.observations, 2), *grid);
          }};
}

std::optional<FaceLightMethod> learnt_transfer(const std::filesystem::path& training, int nside) {
  lighting::RadianceTransferLearner learner;
  for (const synth::TracedPhoto& photo : synth::read_traced(training)) {
    if (photo.features.size() != lighting::kFaceFeatures) {
      throw Error(ExitCode::kInput,
                  "What was read from the photos in " + training.string() +
                      " is of another version. Remove its traced-*.safetensors and run `faceprobe trace` again.");
    }
    learner.add(photo.features, photo.light);
  }
  if (learner.examples() == 0) return std::nullopt;
  return FaceLightMethod{
      "knorr and kurz", [transfer = learner.learn(), grid = std::make_shared<SphereGrid>(nside)](const FaceSeen& seen) {
        return lighting::radiance_of_harmonics(transfer.solve(lighting::face_features(seen.face.observations)), *grid);
      }};
}

FaceLightMethod joint_estimate(int nside, int threads) {
  lighting::JointOptions options;
  options.threads = threads;
  return {"lombardi and nishino, lite", [options, grid = std::make_shared<SphereGrid>(nside)](const FaceSeen& seen) {
            const lighting::JointEstimate found = lighting::solve_lombardi_nishino(seen.face.observations, options);
            return grid_from_grid(found.radiance, SphereGrid(found.nside), *grid);
          }};
}

FaceLightMethod lamp_at_brightest_highlight(int nside) {
  return {"lamp at the brightest highlight", [grid = std::make_shared<SphereGrid>(nside)](const FaceSeen& seen) {
            return brightest_spot(seen.face.observations, *grid);
          }};
}

FaceLightMethod constant_light(const std::string& name, Eigen::MatrixX3f light) {
  return {name, [light = std::move(light)](const FaceSeen&) { return light; }, true};
}

}  // namespace faceprobe::cli
