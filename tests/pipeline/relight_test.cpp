#include "faceprobe/pipeline/relight.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/sphere_grid.h"
#include "portrait.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace faceprobe::pipeline {
namespace {

double mean_of(const Image& photo, const face::Box& box, float from, float to) {
  double sum = 0;
  int count = 0;
  for (int y = static_cast<int>(box.y + 0.4F * box.height); y < static_cast<int>(box.y + 0.7F * box.height); ++y) {
    for (int x = static_cast<int>(box.x + from * box.width); x < static_cast<int>(box.x + to * box.width); ++x, ++count)
      sum += photo(x, y, 0) + photo(x, y, 1) + photo(x, y, 2);
  }
  return sum / count;
}

class Relight : public ::testing::Test {
 protected:
  const Estimate& estimate = testing::portrait_estimate();
  const FaceEstimate& face = estimate.largest_face();
  const Image photo = testing::portrait().linear;
};

TEST_F(Relight, TheSameLightLeavesThePhoto) {
  Image picture = photo;
  relight(picture, face, face.light.radiance);
  for (std::size_t i = 0; i < photo.values().size(); ++i)
    ASSERT_NEAR(picture.data()[i], photo.data()[i], 2e-3F);  // highlights are taken off and put on again by float sums
}

TEST_F(Relight, HalfTheLightHalvesTheFaceAndNothingElse) {
  Image picture = photo;
  relight(picture, face, 0.5F * face.light.radiance);
  const face::Box& box = face.face.box;
  EXPECT_NEAR(mean_of(picture, box, 0.3F, 0.7F) / mean_of(photo, box, 0.3F, 0.7F), 0.5,
              2e-3);  // it is linear; float sums
  EXPECT_EQ(picture(2, 2, 0), photo(2, 2, 0));
  EXPECT_EQ(picture(photo.width() - 3, photo.height() - 3, 1), photo(photo.width() - 3, photo.height() - 3, 1));
}

TEST_F(Relight, ALampAtTheRightLightsTheRight) {
  const SphereGrid grid = SphereGrid::of_cells(face.light.radiance.rows());
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.05F * face.light.radiance.mean());
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).dot(Eigen::Vector3f(0.94F, 0, 0.34F)) > 0.9F)
      light.row(j).setConstant(20 * face.light.radiance.mean());
  }
  Image picture = photo;
  relight(picture, face, light);
  const face::Box& box = face.face.box;
  const double right = mean_of(picture, box, 0.65F, 0.85F) / mean_of(photo, box, 0.65F, 0.85F);
  const double left = mean_of(picture, box, 0.15F, 0.35F) / mean_of(photo, box, 0.15F, 0.35F);
  EXPECT_GT(right, 1.5 * left);
}

TEST_F(Relight, TheUsualWishesChangeTheLightAsTheySay) {
  const EstimateOptions options;
  const Eigen::MatrixX3f& own = face.light.radiance;
  EXPECT_TRUE(changed_light(face, {.map = {}, .exposure = 1}, options).isApprox(2 * own));
  const Eigen::MatrixX3f dimmed = changed_light(face, {.map = {}, .dim = {{.light = 1}}}, options);
  EXPECT_LT(dimmed.sum(), own.sum());
  EXPECT_TRUE((dimmed.array() <= own.array() + 1e-6F).all());
  // What is in front goes to the right.
  const SphereGrid grid = SphereGrid::of_cells(own.rows());
  EnvMap front(64, 32);
  std::fill_n(front.radiance().pixel(32, 16), 3, 1.0F);
  const Eigen::MatrixX3f turned = changed_light(face, {.map = front, .turn_deg = 90}, options);
  Eigen::Index brightest = 0;
  turned.rowwise().sum().maxCoeff(&brightest);
  EXPECT_GT(grid.direction(static_cast<int>(brightest)).x(), 0.95F);
  EXPECT_NEAR(turned.sum() / own.sum(), 1, 0.02);  // as strong; the turn resamples
  EXPECT_NE(LightChange{}.validate(), "");
  EXPECT_NE((LightChange{.map = front, .dim = {{.light = 1}}}).validate(), "");
  EXPECT_THROW(changed_light(face, {.map = EnvMap(8, 4)}, options), Error);
  EXPECT_NE((LightChange{.map = {}, .exposure = 99}).validate(), "");
  EXPECT_EQ((LightChange{.map = {}, .turn_deg = -20}).validate(), "");
}

// Two lights of 8 degrees, the second weaker, in an even surround.
FaceEstimate under_two_lights() {
  FaceEstimate face;
  const SphereGrid grid(16);
  face.light.radiance = Eigen::MatrixX3f::Constant(grid.cell_count(), 3, 0.1F);
  face.light.confidence = Eigen::VectorXf::Ones(grid.cell_count());
  const Eigen::Vector3f right = Eigen::Vector3f(0.8F, 0.3F, 0.5F).normalized();
  const Eigen::Vector3f left = Eigen::Vector3f(-0.8F, 0.3F, 0.5F).normalized();
  for (int j = 0; j < grid.cell_count(); ++j) {
    if (grid.direction(j).dot(right) > 0.99F) face.light.radiance.row(j) = Eigen::RowVector3f(20, 16, 12);
    if (grid.direction(j).dot(left) > 0.99F) face.light.radiance.row(j) = Eigen::RowVector3f(6, 8, 10);
  }
  face.lights = lighting::main_lights(face.light.radiance, grid, {}, face.light.confidence);
  return face;
}

TEST(LightChange, TakesOfEachLightTheShareThatIsNamed) {
  const FaceEstimate face = under_two_lights();
  ASSERT_EQ(face.lights.size(), 2U);
  ASSERT_LT(face.lights[1].direction.x(), 0);
  const SphereGrid grid(16);
  const Eigen::MatrixX3f& own = face.light.radiance;
  const std::vector<std::vector<DimmedLight>> changes = {{{.light = 2, .share = 1}},
                                                         {{.light = 2, .share = 0.25}},
                                                         {{.light = 1, .share = 0.5}},
                                                         {{.light = 2, .share = 0.75}, {.light = 1, .share = 0.125}}};
  for (const std::vector<DimmedLight>& dim : changes) {
    const Eigen::MatrixX3f rest = changed_light(face, {.map = {}, .dim = dim}, EstimateOptions());
    double wanted = 0;
    for (const DimmedLight& dimmed : dim)
      wanted += dimmed.share * face.lights[static_cast<std::size_t>(dimmed.light - 1)].irradiance;
    const double gone = ((own - rest) * kLuminanceWeights).cast<double>().sum() * grid.cell_solid_angle();
    EXPECT_NEAR(gone, wanted, 1e-4 * wanted);  // sums of floats
    for (int j = 0; j < grid.cell_count(); ++j) {
      const bool at_right = grid.direction(j).x() > 0;
      const bool touched =
          std::ranges::any_of(dim, [&](const DimmedLight& dimmed) { return (dimmed.light == 1) == at_right; });
      if (!touched) {
        ASSERT_EQ(rest.row(j), own.row(j)) << j;
      }
    }
  }
}

TEST(LightChange, SaysWhichLightItCannotDim) {
  const auto fault = [](const std::vector<DimmedLight>& dim) { return LightChange{.map = {}, .dim = dim}.validate(); };
  EXPECT_EQ(fault({{.light = 5}, {.light = 1, .share = 0.5}}), "");
  EXPECT_NE(fault({{.light = 0}}).find("from 1"), std::string::npos);
  EXPECT_NE(fault({{.light = 6}}).find("found 6"), std::string::npos);
  EXPECT_NE(fault({{.light = 2}, {.light = 2, .share = 0.5}}).find("twice"), std::string::npos);
  for (const double share : {0.0, -1.0, 1.5, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(fault({{.light = 2, .share = share}}).find("share of light 2"), std::string::npos) << share;
  Estimate estimate;
  estimate.faces.push_back(under_two_lights());
  EXPECT_EQ((LightChange{.map = {}, .dim = {{.light = 2}}}.fault_of(estimate)), "");
  const std::string missing = LightChange{.map = {}, .dim = {{.light = 3}}}.fault_of(estimate);
  EXPECT_NE(missing.find("2 main lights at most"), std::string::npos) << missing;
}

TEST_F(Relight, RefusesWhatDoesNotFit) {
  Image picture = photo;
  EXPECT_THROW(relight(picture, face, Eigen::MatrixX3f::Ones(12, 3)), std::invalid_argument);
  EXPECT_THROW(relight(picture, face, face.light.radiance, {.shading_px = 2}), std::invalid_argument);
  Image grey(photo.width(), photo.height(), 1);
  EXPECT_THROW(relight(grey, face, face.light.radiance), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::pipeline
