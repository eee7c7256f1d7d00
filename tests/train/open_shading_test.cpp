#include "train/open_shading.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/region.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace faceprobe::train {
namespace {

// Normals of a ball that faces the viewer, all of it a nose.
struct Ball {
  Image normal{33, 33, 3};
  ByteImage region{33, 33, 1};

  Ball() {
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 33; ++x) {
        const double u = (x - 16) / 16.5;
        const double v = (16 - y) / 16.5;
        if (u * u + v * v >= 1) continue;
        Eigen::Map<Eigen::Vector3f>(normal.pixel(x, y)) =
            Eigen::Vector3d(u, v, std::sqrt(1 - u * u - v * v)).cast<float>();
        region(x, y) = static_cast<std::uint8_t>(Region::kNose);
      }
    }
  }
};

TEST(OpenShading, OfAnEvenSkyIsItsRadiance) {
  EnvMap sky(64, 32);
  for (int i = 0; i < 64 * 32; ++i) {
    float* texel = sky.radiance().data() + 3 * i;
    texel[0] = 0.5F, texel[1] = 1, texel[2] = 2;
  }
  const Ball ball;
  const Image open = open_shading(sky, ball.normal, ball.region);
  // The texels' sum stands for an integral.
  EXPECT_NEAR(open(16, 16, 0), 0.5F, 5e-3F);
  EXPECT_NEAR(open(4, 20, 1), 1, 1e-2F);
  EXPECT_NEAR(open(25, 9, 2), 2, 2e-2F);
}

// Of a lamp the cosine, as closely as harmonics of order 4 have it: their error is largest, .059, where the cosine ends.
TEST(OpenShading, OfALampIsTheCosine) {
  EnvMap map(64, 32);
  const int x = 24;
  const int y = 9;
  map.radiance()(x, y, 1) = static_cast<float>(kPi / texel_solid_angle(y, 64, 32));  // irradiance pi
  const Eigen::Vector3f towards = map.direction(x, y);
  const Ball ball;
  const Image open = open_shading(map, ball.normal, ball.region);
  double worst = 0;
  for (int v = 0; v < 33; ++v) {
    for (int u = 0; u < 33; ++u) {
      if (ball.region(u, v) == 0) continue;
      const float cosine = Eigen::Map<const Eigen::Vector3f>(ball.normal.pixel(u, v)).dot(towards);
      worst = std::max(worst, std::abs(static_cast<double>(open(u, v, 1) - std::max(0.0F, cosine))));
      EXPECT_EQ(open(u, v, 0), 0);
    }
  }
  EXPECT_LT(worst, 0.065);  // and the grid that is looked up
  EXPECT_GT(worst, 0.01);   // it is not the cosine itself
}

TEST(OpenShading, IsOfTheFaceAlone) {
  Ball ball;
  EnvMap sky(64, 32);
  for (float& value : sky.radiance().values()) value = 1;
  ball.region(16, 16) = static_cast<std::uint8_t>(Region::kHair);
  const Image open = open_shading(sky, ball.normal, ball.region);
  EXPECT_EQ(open(16, 16, 1), 0);
  EXPECT_EQ(open(0, 0, 1), 0);
  EXPECT_GT(open(15, 16, 1), 0.9F);
  // Nothing is known of no map.
  EXPECT_EQ(open_shading(EnvMap(), ball.normal, ball.region), Image(33, 33, 3));
}

}  // namespace
}  // namespace faceprobe::train
