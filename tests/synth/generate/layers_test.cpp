#include "faceprobe/synth/compose.h"
#include "synth/generate/small_world.h"

#include <gtest/gtest.h>

namespace faceprobe::synth {
namespace {

TEST(Layers, DiffuseIsAlbedoTimesShading) {
  const Assets assets = small_assets();
  Recipe recipe = small_recipe();
  recipe.mode = Mode::kPaper;  // black behind: the identity holds at the rim too
  const std::vector<ViewSamples> views = generate_person(assets, recipe, 1);
  for (const ViewSamples& view : views) {
    for (const Sample& sample : view.samples) {
      for (std::size_t i = 0; i < sample.diffuse.values().size(); ++i) {
        const float product = sample.albedo.data()[i] * sample.shading.data()[i];
        EXPECT_NEAR(sample.diffuse.data()[i], product, 1e-5F + 1e-4F * product);  // one division and one product in float
      }
    }
  }
}

// A flat grey square before the camera, one fragment a pixel.
Fragments flat_skin(int size_px) {
  Fragments flat;
  flat.width_px = flat.height_px = size_px;
  const int count = size_px * size_px;
  for (int i = 0; i < count; ++i) {
    flat.pixel.push_back(i);
    flat.coverage.push_back(1);
    flat.material.push_back(Material::kSkin);
    flat.region.push_back(Region::kCheeks);
    flat.figure.push_back(0);
    flat.part.push_back(0);
    flat.tone.push_back(1);
  }
  flat.depth_m = Eigen::VectorXf::Constant(count, 1.0F);
  return flat;
}

TEST(Scatter, LeavesEvenLightAsItIs) {
  const Fragments flat = flat_skin(32);
  const PinholeCamera camera{.width_px = 32, .height_px = 32, .focal_px = 2000};
  Eigen::MatrixX3f shading = Eigen::MatrixX3f::Constant(flat.count(), 3, 0.7F);
  scatter_below_surface(flat, camera, shading);
  EXPECT_LT((shading.array() - 0.7F).abs().maxCoeff(), 1e-5F);  // float sums of about twenty taps
}

TEST(Scatter, RedReachesFarthest) {
  const Fragments flat = flat_skin(32);
  const PinholeCamera camera{.width_px = 32, .height_px = 32, .focal_px = 2000};  // 2 px a millimetre
  Eigen::MatrixX3f shading = Eigen::MatrixX3f::Zero(flat.count(), 3);
  for (int y = 0; y < 32; ++y) {
    for (int x = 16; x < 32; ++x) shading.row(y * 32 + x).setOnes();
  }
  scatter_below_surface(flat, camera, shading);
  const Eigen::RowVector3f in_shadow = shading.row(16 * 32 + 13);  // 1.25 mm into the dark side
  EXPECT_GT(in_shadow(0), in_shadow(1));
  EXPECT_GT(in_shadow(1), in_shadow(2));
  EXPECT_GT(in_shadow(0), 0.05F);
}

}  // namespace
}  // namespace faceprobe::synth
