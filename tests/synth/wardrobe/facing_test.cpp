#include "faceprobe/synth/scene.h"
#include "faceprobe/synth/wardrobe.h"
#include "synth/wardrobe/egg_head.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace faceprobe::synth {
namespace {

// Share of what is seen of clothes from all round that shows its back. A mesh turned inside out takes its light from within.
double share_facing_away(const Scene& scene) {
  int seen = 0;
  int away = 0;
  for (int view = 0; view < 8; ++view) {
    const float angle = 0.785F * static_cast<float>(view);
    const Eigen::Vector3f back = Eigen::Vector3f(std::sin(angle), 0.1F, std::cos(angle)).normalized();
    const Eigen::Vector3f right = Eigen::Vector3f::UnitY().cross(back).normalized();
    const Eigen::Vector3f up = back.cross(right);
    for (int y = -30; y < 20; ++y) {
      for (int x = -25; x <= 25; ++x) {
        const Eigen::Vector3f origin =
            2.0F * back + 0.012F * (static_cast<float>(x) * right + static_cast<float>(y) * up);
        const Hit hit = scene.first_hit(origin, -back);
        if (hit.figure < 0 || hit.strand) continue;
        const SurfaceMesh& mesh =
            scene.figures()[static_cast<std::size_t>(hit.figure)].meshes[static_cast<std::size_t>(hit.part)];
        if (mesh.material != Material::kCloth) continue;
        ++seen;
        Eigen::Vector3f normal = Eigen::Vector3f::Zero();
        for (int k = 0; k < 3; ++k) normal += mesh.normals.row(mesh.triangles(hit.primitive, k)).transpose();
        away += normal.dot(back) < 0 ? 1 : 0;
      }
    }
  }
  return seen > 0 ? static_cast<double>(away) / seen : 1.0;
}

class Clothes : public ::testing::TestWithParam<Headwear> {};

TEST_P(Clothes, TurnTheirOutsideOut) {
  const Head head = egg_head();
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {  // tees, shirts, hoodies and jackets among them
    WardrobeSettings settings;
    settings.cut = HairCut::kBald;
    settings.headwear = GetParam();
    settings.seed = seed;
    const Scene scene({head.figure, dress(head, settings)});
    // Folds and the inside of collars show a little of their backs.
    EXPECT_LT(share_facing_away(scene), 0.06) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Clothes,
                         testing::Values(Headwear::kNone, Headwear::kBeanie, Headwear::kCap, Headwear::kScarf));

}  // namespace
}  // namespace faceprobe::synth
