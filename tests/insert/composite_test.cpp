#include "faceprobe/insert/composite.h"

#include <gtest/gtest.h>

namespace faceprobe::insert {
namespace {

// One pixel, in a photo of one.
render::Layers layers_of(const Eigen::Vector4f& object, float shadow, float ground, float depth) {
  render::Layers layers{Image(1, 1, 4),        Image(1, 1, 3, shadow), Image(1, 1, 1, ground),
                        Image(1, 1, 1, depth), Image(1, 1, 3),         Image(1, 1, 1)};
  Eigen::Map<Eigen::Vector4f>(layers.object.pixel(0, 0)) = object;
  return layers;
}

constexpr PixelBox kBox{0, 0, 1, 1};

TEST(Composite, IsTheEquationOfTheHeader) {
  Image picture(1, 1, 3, 0.8F);
  composite(picture, kBox, layers_of({0.1F, 0.2F, 0.3F, 0.5F}, 0.25F, 0.4F, 1), {});
  EXPECT_FLOAT_EQ(picture(0, 0, 0), 0.1F + (0.4F * 0.25F + 0.1F) * 0.8F);
  EXPECT_FLOAT_EQ(picture(0, 0, 2), 0.3F + (0.4F * 0.25F + 0.1F) * 0.8F);
}

TEST(Composite, NothingDrawnLeavesThePhoto) {
  Image picture(1, 1, 3, 0.37F);
  composite(picture, kBox, layers_of({0, 0, 0, 0}, 1, 1, 0), {});
  EXPECT_EQ(picture(0, 0, 1), 0.37F);
}

TEST(Composite, WhoStandsNearerHidesModelAndShadow) {
  const render::PinholeView view{1, 0.5, 0.5, 1, 1};
  const render::Ground ground{.point_m = {0, 0, -3}, .up = {0, 0, 1}};  // a wall at 3 m
  const auto hidden_at = [&](float person_m, float model_m) {
    const Matte matte{Image(1, 1, 1, 0.75F), Image(1, 1, 1, person_m)};
    return hidden_by(matte, layers_of({1, 1, 1, 1}, 1, 0, model_m), view, ground, kBox);
  };
  EXPECT_EQ(hidden_at(1, 2).model(0, 0), 0.75F);  // person, model, wall
  EXPECT_EQ(hidden_at(1, 2).ground(0, 0), 0.75F);
  EXPECT_EQ(hidden_at(2.5F, 2).model(0, 0), 0);  // model, person, wall
  EXPECT_EQ(hidden_at(2.5F, 2).ground(0, 0), 0.75F);
  EXPECT_EQ(hidden_at(4, 2).ground(0, 0), 0);  // model, wall, person

  Image picture(1, 1, 3, 0.5F);
  composite(picture, kBox, layers_of({1, 1, 1, 1}, 0.2F, 0, 2), hidden_at(1, 2));
  EXPECT_FLOAT_EQ(picture(0, 0, 0), 0.25F * 1 + 0.75F * 0.5F);
}

}  // namespace
}  // namespace faceprobe::insert
