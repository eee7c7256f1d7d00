#include "faceprobe/lighting/trace.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <nanoflann.hpp>
#include <stdexcept>
#include <vector>

namespace faceprobe::lighting {

std::string TraceOptions::validate() const {
  if (neighbours < 1) return "neighbours must be 1 or more, found " + std::to_string(neighbours) + ".";
  if (!(max_normal_gap_deg >= 0 && max_normal_gap_deg <= 180))
    return "max_normal_gap_deg must be from 0 to 180, found " + std::to_string(max_normal_gap_deg) + ".";
  return {};
}

TracedMap trace_highlights(const Observations& observations, const Eigen::MatrixX3f& highlight, const SphereGrid& grid,
                           const TraceOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (highlight.rows() != observations.count()) throw std::invalid_argument("One highlight per observation is needed.");
  TracedMap traced;
  traced.value.setZero(grid.cell_count(), 3);
  constexpr Microfacet kSkin;
  traced.roughness.setConstant(grid.cell_count(), kSkin.roughness);
  traced.specular_albedo.setConstant(grid.cell_count(), kSkin.specular_albedo);
  traced.weight.setZero(grid.cell_count());
  if (observations.count() == 0) return traced;

  const Eigen::Vector3f view = observations.view.colwise().mean().transpose().normalized();
  using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Eigen::MatrixX3f, 3>;
  const Tree tree(3, std::cref(observations.normal), 16);
  const auto wanted = static_cast<std::size_t>(std::min<Eigen::Index>(options.neighbours, observations.count()));
  std::vector<Eigen::Index> index(wanted);
  std::vector<float> squared(wanted);
  const double gap = 2.0 * std::sin(radians(options.max_normal_gap_deg) / 2.0);  // chord of the angle
  for (int cell = 0; cell < grid.cell_count(); ++cell) {
    const Eigen::Vector3f sum = grid.direction(cell) + view;
    if (sum.norm() < 1e-3F) continue;  // straight behind the head: any normal at 90 degrees would do, none does
    const Eigen::Vector3f mirror = sum.normalized();
    nanoflann::KNNResultSet<float, Eigen::Index> found(wanted);
    found.init(index.data(), squared.data());
    tree.index->findNeighbors(found, mirror.data(), nanoflann::SearchParams());
    if (squared[0] > static_cast<float>(gap * gap)) continue;
    float total = 0;
    Eigen::RowVector3f value = Eigen::RowVector3f::Zero();
    float roughness = 0;
    float specular_albedo = 0;
    for (std::size_t k = 0; k < wanted; ++k) {
      // Inverse squared distance, softened by half a degree: closer than that the normals are not known.
      const float w = observations.weight[index[k]] / (squared[k] + 7.6e-5F);
      total += w;
      value += w * highlight.row(index[k]);
      roughness += w * observations.roughness[index[k]];
      specular_albedo += w * observations.specular_albedo[index[k]];
    }
    if (!(total > 0)) continue;
    traced.value.row(cell) = value / total;
    traced.roughness[cell] = roughness / total;
    traced.specular_albedo[cell] = specular_albedo / total;
    traced.weight[cell] = 1.0F;
  }
  return traced;
}

}  // namespace faceprobe::lighting
