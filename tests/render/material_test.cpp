#include "faceprobe/render/material.h"

#include "faceprobe/core/error.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace faceprobe::render {
namespace {

using faceprobe::testing::expect_error;

TEST(Colours, OfWebPagesAreDecodedAndNumbersAreLinear) {
  const Eigen::Vector3f web = colour_from("#ff8000");
  EXPECT_FLOAT_EQ(web.x(), 1);
  EXPECT_FLOAT_EQ(web.y(), std::pow((128.0F / 255 + 0.055F) / 1.055F, 2.4F));  // IEC 61966-2-1
  EXPECT_EQ(web.z(), 0);
  EXPECT_EQ(colour_from("#FF8000"), web);
  EXPECT_EQ(colour_from("0.5,0,1"), Eigen::Vector3f(0.5F, 0, 1));
  EXPECT_EQ(colour_from("-1,2,1e1"), Eigen::Vector3f(-1, 2, 10));  // whether a material may have it is asked there
}

TEST(Colours, OtherTextsAreRefused) {
  for (const std::string text : {"", "red", "#", "#ff800", "#ff80000", "#gg0000", "#-10000", "1,2", "1,2,3,4", "1,2,",
                                 ",,", "1, 2, 3", "1;2;3", "0x1,0,0", "#ff,0,0"})
    expect_error(ExitCode::kUsage, {"R,G,B", "'" + text + "'"}, [&] { colour_from(text); });
}

TEST(MaterialKinds, HaveNames) {
  EXPECT_EQ(material_kind_names().size(), 4U);
  for (const std::string& name : material_kind_names())
    EXPECT_EQ(material_kind_name(material_kind_from_name(name)), name);
  EXPECT_EQ(material_kind_from_name("glass"), MaterialKind::kGlass);
  expect_error(ExitCode::kUsage, {"'wood'", "diffuse, metal, plastic, glass"}, [] { material_kind_from_name("wood"); });
}

TEST(MaterialChange, LeavesWhatItDoesNotName) {
  Material wood = material_preset("red");
  wood.texture = Image(2, 2, 3, 0.5F);
  EXPECT_TRUE(MaterialChange{}.empty());
  const Material rough = changed(wood, {.roughness = 0.7F});
  EXPECT_EQ(rough.roughness, 0.7F);
  EXPECT_EQ(rough.colour, wood.colour);
  EXPECT_EQ(rough.kind, wood.kind);
  EXPECT_EQ(rough.ior, wood.ior);
  EXPECT_EQ(rough.texture, wood.texture);
  const Material blue = changed(wood, {.kind = MaterialKind::kGlass, .colour = Eigen::Vector3f(0, 0, 1), .ior = 1.7F});
  EXPECT_EQ(blue.kind, MaterialKind::kGlass);
  EXPECT_EQ(blue.colour, Eigen::Vector3f(0, 0, 1));
  EXPECT_TRUE(blue.texture.empty());  // a picture would tint it
  EXPECT_EQ(blue.ior, 1.7F);
  EXPECT_EQ(blue.roughness, wood.roughness);
}

TEST(MaterialChange, ValidatesAsMaterialsDo) {
  EXPECT_EQ(MaterialChange{}.validate(), "");
  EXPECT_EQ((MaterialChange{.colour = Eigen::Vector3f(0, 1, 0.5F), .roughness = 1, .ior = 3}.validate()), "");
  const auto says = [](const MaterialChange& change, const std::string& word) {
    return change.validate().find(word) != std::string::npos;
  };
  EXPECT_TRUE(says({.colour = Eigen::Vector3f(0, 1.1F, 0)}, "colour"));
  EXPECT_TRUE(says({.roughness = -0.1F}, "roughness"));
  EXPECT_TRUE(says({.roughness = std::numeric_limits<float>::quiet_NaN()}, "roughness"));
  EXPECT_TRUE(says({.ior = 0.9F}, "refraction"));
}

}  // namespace
}  // namespace faceprobe::render
