#include "faceprobe/lighting/transport.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"
#include "faceprobe/core/parallel.h"
#include "lighting/horizon_profile.h"
#include "lighting/skin_of.h"

#include <stdexcept>

namespace faceprobe::lighting {

Transport build_transport(const Observations& observations, const SphereGrid& grid, int threads, Fresnel fresnel,
                          DiffuseRows diffuse) {
  return build_transport(observations, grid.directions(), static_cast<float>(grid.cell_solid_angle()), threads, fresnel,
                         diffuse);
}

Transport build_transport(const Observations& observations, const Eigen::MatrixX3f& directions, float solid_angle_sr,
                          int threads, Fresnel fresnel, DiffuseRows diffuse_rows) {
  if (const std::string fault = observations.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const bool shadowed = observations.horizon.rows() > 0;
  const std::vector<HorizonPlace> places = shadowed ? horizon_places(directions) : std::vector<HorizonPlace>();
  Transport transport;
  transport.rows.resize(2 * observations.count(), directions.rows());
  parallel_for(static_cast<int>(observations.count()), threads, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      // Cleared here, so that the threads share the cost of fresh pages.
      auto highlight = transport.rows.row(i);
      auto diffuse = transport.rows.row(observations.count() + i);
      highlight.setZero();
      diffuse.setZero();
      const Eigen::Vector3f normal = observations.normal.row(i).transpose();
      const Eigen::Vector3f view = observations.view.row(i).transpose();
      const Microfacet skin = skin_of(observations, i, fresnel);
      HorizonProfile profile{};
      if (shadowed) profile = horizon_profile(observations.horizon.row(i));
      for (Eigen::Index j = 0; j < directions.rows(); ++j) {
        const Eigen::Vector3f light = directions.row(j).transpose();
        const float cosine = normal.dot(light);
        if (cosine <= 0.0F) continue;
        const float visible =
            solid_angle_sr * (shadowed ? profile_visibility(profile, places[static_cast<std::size_t>(j)]) : 1.0F);
        const float lit = diffuse_rows == DiffuseRows::kOpenShading ? solid_angle_sr : visible;
        diffuse[j] = lit * cosine / static_cast<float>(kPi);
        if (visible > 0.0F) highlight[j] = visible * specular_lobe(normal, view, light, skin);
      }
    }
  });
  return transport;
}

}  // namespace faceprobe::lighting
