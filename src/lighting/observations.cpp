#include "faceprobe/lighting/observations.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/microfacet.h"

#include <algorithm>

namespace faceprobe::lighting {

void Observations::resize(Eigen::Index patches) {
  normal.setZero(patches, 3);
  view.setZero(patches, 3);
  highlight.setZero(patches, 3);
  shading.setZero(patches, 3);
  open_shading.resize(0, 3);
  clipped.setConstant(patches, 3, false);
  constexpr Microfacet kSkin;
  roughness.setConstant(patches, kSkin.roughness);
  specular_albedo.setConstant(patches, kSkin.specular_albedo);
  weight.setOnes(patches);
  horizon.resize(0, kHorizonAzimuths);
  grey = false;
}

std::string Observations::validate() const {
  const Eigen::Index n = count();
  if (view.rows() != n || highlight.rows() != n || shading.rows() != n || clipped.rows() != n ||
      roughness.size() != n || specular_albedo.size() != n || weight.size() != n) {
    return "Observations need as many views, layers, flags, reflectances and weights as normals.";
  }
  if (horizon.rows() != 0 && (horizon.rows() != n || horizon.cols() != kHorizonAzimuths)) {
    return "Observations need a horizon of " + std::to_string(kHorizonAzimuths) + " azimuths for each normal, or none.";
  }
  if (open_shading.rows() != 0 && open_shading.rows() != n)
    return "Observations need an open shading for each normal, or none.";
  if (n == 0) return {};
  if (!normal.allFinite() || !view.allFinite() || !highlight.allFinite() || !shading.allFinite() ||
      !weight.allFinite() || !open_shading.allFinite()) {
    return "Observations hold values that are not finite.";
  }
  const bool dark = open_shading.size() > 0 && open_shading.minCoeff() < 0;
  if (highlight.minCoeff() < 0 || shading.minCoeff() < 0 || dark) return "Observations hold negative light.";
  if (!horizon.allFinite() || !roughness.allFinite()) return "Observations hold values that are not finite.";
  const auto unit = [](const Eigen::MatrixX3f& rows) {
    constexpr float kTolerance = 0.01F;  // normals may come from files of half floats
    return ((rows.rowwise().norm().array() - 1).abs() < kTolerance).all();
  };
  if (!unit(normal) || !unit(view)) return "Normals and views must be of unit length.";
  if (weight.minCoeff() < 0 || !(weight.maxCoeff() > 0))
    return "Observation weights must not be negative, and some must be above 0.";
  if (roughness.minCoeff() < 0.02F || roughness.maxCoeff() > 1.0F) return "Roughness must lie in [.02, 1].";
  if (!specular_albedo.allFinite() || !(specular_albedo.minCoeff() > 0)) return "Specular albedos must be positive.";
  return {};
}

Observations concatenate(const std::vector<Observations>& sets) {
  Eigen::Index total = 0;
  bool any_horizon = false;
  for (const Observations& set : sets) {
    total += set.count();
    any_horizon = any_horizon || set.horizon.rows() > 0;
  }
  Observations all;
  all.resize(total);
  all.grey = !sets.empty() && std::ranges::all_of(sets, [](const Observations& set) { return set.grey; });
  if (any_horizon) all.horizon.setConstant(total, kHorizonAzimuths, kNothingBlocks);
  const bool all_open =
      std::ranges::all_of(sets, [](const Observations& set) { return set.open_shading.rows() == set.count(); });
  if (all_open) all.open_shading.setZero(total, 3);
  Eigen::Index at = 0;
  for (const Observations& set : sets) {
    const Eigen::Index n = set.count();
    if (all_open) all.open_shading.middleRows(at, n) = set.open_shading;
    all.normal.middleRows(at, n) = set.normal;
    all.view.middleRows(at, n) = set.view;
    all.highlight.middleRows(at, n) = set.highlight;
    all.shading.middleRows(at, n) = set.shading;
    all.clipped.middleRows(at, n) = set.clipped;
    all.roughness.segment(at, n) = set.roughness;
    all.specular_albedo.segment(at, n) = set.specular_albedo;
    all.weight.segment(at, n) = set.weight;
    if (set.horizon.rows() > 0) all.horizon.middleRows(at, n) = set.horizon;
    at += n;
  }
  return all;
}

bool shows_highlights(const Observations& observations) {
  constexpr double kLeastShare = 0.05;
  double found = 0;
  double straight_on = 0;
  for (Eigen::Index i = 0; i < observations.count(); ++i) {
    const auto weight = static_cast<double>(observations.weight[i]);
    const float shading = observations.shading.row(i).dot(kLuminanceWeights.transpose());
    found += weight * static_cast<double>(observations.highlight.row(i).dot(kLuminanceWeights.transpose()));
    straight_on += weight * static_cast<double>(observations.specular_albedo[i] * kSkinF0 * shading);
  }
  return found > 0 && found >= kLeastShare * straight_on;
}

}  // namespace faceprobe::lighting
