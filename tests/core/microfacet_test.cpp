#include "faceprobe/core/microfacet.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/sphere_grid.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace faceprobe {
namespace {

const Eigen::Vector3f kUp(0, 1, 0);

Eigen::Vector3f tilted(double degrees_from_normal) {
  return direction_from_angles(0, 90 - degrees_from_normal).cast<float>();
}

TEST(Microfacet, LobeIsReciprocal) {
  // f is symmetric, and specular_lobe carries a factor N.L.
  const Microfacet skin;
  const Eigen::Vector3f a = direction_from_angles(20, 50).cast<float>();
  const Eigen::Vector3f b = direction_from_angles(-130, 35).cast<float>();
  EXPECT_NEAR(specular_lobe(kUp, a, b, skin) / kUp.dot(b), specular_lobe(kUp, b, a, skin) / kUp.dot(a), 1e-6);
}

TEST(Microfacet, BeckmannIsANormalisedDistribution) {
  // int D(h) / pi cos(h) dh = 1 over the hemisphere.
  for (const float m : {0.1F, 0.3F, 0.5F}) {
    double sum = 0;
    const int steps = 20'000;
    for (int i = 0; i < steps; ++i) {
      const double c = (i + 0.5) / steps;
      sum += 2 * kPi * beckmann(static_cast<float>(c), m) / kPi * c / steps;
    }
    EXPECT_NEAR(sum, 1.0, 1e-3) << m;  // midpoint rule, steepest at m = .1
  }
}

TEST(Microfacet, MetalNeverReflectsMoreThanItReceives) {
  const SphereGrid grid(32);
  for (const double angle : {0.0, 30.0, 60.0, 80.0}) {
    const Eigen::Vector3f view = tilted(angle);
    double reflected = 0;
    for (int j = 0; j < grid.cell_count(); ++j) {
      reflected +=
          specular_lobe(kUp, view, grid.direction(j), {.roughness = 0.3F, .specular_albedo = 0.25F, .f0 = 1.0F});
    }
    reflected *= grid.cell_solid_angle();
    EXPECT_LE(reflected, 1.0) << angle;
    // Single scattering loses what bounces twice: a few percent at m = .3 head on, up to a third at grazing angles.
    EXPECT_GE(reflected, angle < 45 ? 0.95 : 0.6) << angle;
  }
}

TEST(Microfacet, FresnelRisesAsTheDossierOfSkinSays) {
  // F / F0 at 0, 60 and 75 degrees of incidence: 1.0, 2.1, 8.8.
  const auto ratio = [](double degrees) {
    return schlick_fresnel(static_cast<float>(std::cos(radians(degrees))), kSkinF0) / kSkinF0;
  };
  EXPECT_NEAR(ratio(0), 1.0, 1e-6);
  EXPECT_NEAR(ratio(60), 2.1, 0.05);
  EXPECT_NEAR(ratio(75), 8.8, 0.1);
}

TEST(Microfacet, NothingFromBehind) {
  EXPECT_EQ(specular_lobe(kUp, tilted(20), tilted(100), {}), 0.0F);
  EXPECT_EQ(specular_lobe(kUp, tilted(100), tilted(20), {}), 0.0F);
  EXPECT_EQ(specular_lobe(kUp, tilted(90.001), -tilted(90.001), {}), 0.0F);
}

}  // namespace
}  // namespace faceprobe
