#include "faceprobe/lighting/radiance_transfer.h"

#include "faceprobe/core/sh.h"
#include "faceprobe/lighting/albedo.h"
#include "faceprobe/lighting/harmonics.h"
#include "synthetic_face.h"

#include <gtest/gtest.h>

#include <random>

namespace faceprobe::lighting {
namespace {

const SphereGrid& cells() {
  static const SphereGrid grid(kFeatureNside);
  return grid;
}

Eigen::MatrixXd harmonics_at_cells() {
  Eigen::MatrixXd values(kFeatureCells, kTransferTerms);
  for (int j = 0; j < kFeatureCells; ++j) values.row(j) = sh::basis(2, cells().direction(j).cast<double>()).transpose();
  return values;
}

// The cosine's transfer, darker towards the feet as a face in its own shadow.
Eigen::MatrixXd shadowed_transfer() {
  Eigen::MatrixXd transfer = harmonics_at_cells();
  for (int l = 0; l <= 2; ++l) transfer.middleCols(l * l, 2 * l + 1) *= sh::cosine_lobe(l) / kPi;
  for (int j = 0; j < kFeatureCells; ++j) transfer.row(j) *= 0.8 + 0.2 * static_cast<double>(cells().direction(j).y());
  return transfer;
}

// What a face without highlights would say, cells that face away from the camera left out. Intensities must not be below 0.
Eigen::VectorXf features_of(const Eigen::MatrixX3d& intensities, float known = 0.8F) {
  Eigen::VectorXf features = Eigen::VectorXf::Zero(kFaceFeatures);
  for (int j = 0; j < kFeatureCells; ++j) {
    if (cells().direction(j).z() < 0.1F) continue;
    features.segment<3>(4 * j) = (static_cast<double>(known) * intensities.row(j).transpose()).cwiseSqrt().cast<float>();
    features[4 * j + 3] = known;
  }
  return features;
}

Eigen::MatrixX3d light_of_order_2() {
  Eigen::MatrixX3d light(kTransferTerms, 3);
  light << 3, 2.5, 2, 0.8, 0.5, 0.2, 1, 1.1, 1.2, -0.6, -0.4, -0.2, 0.2, 0, 0, 0.1, 0.1, 0, -0.2, 0.1, 0, 0, 0.2, 0.1,
      0.1, 0, -0.1;
  return light;
}

RadianceTransfer exact() { return {shadowed_transfer(), Eigen::VectorXd::Ones(kFeatureCells)}; }

TEST(RadianceTransfer, GivesBackLightOfOrderTwo) {
  const Eigen::MatrixX3d light = light_of_order_2();
  const Eigen::MatrixX3d found = exact().solve(features_of(shadowed_transfer() * light), 1e-9);
  EXPECT_LT((found - light).cwiseAbs().maxCoeff(), 1e-3);  // features in single precision, one side of the sphere only
}

TEST(RadianceTransfer, DoesWithoutPointsThatAreNotSeen) {
  const Eigen::MatrixX3d light = light_of_order_2();
  Eigen::VectorXf features = features_of(shadowed_transfer() * light);
  for (int j = 0; j < kFeatureCells; ++j) {
    if (cells().direction(j).x() > 0.2F) features.segment<4>(4 * j).setZero();
  }
  EXPECT_LT((exact().solve(features, 1e-9) - light).cwiseAbs().maxCoeff(), 5e-3);
}

TEST(RadianceTransfer, NoiseCostsLittleWhereTheFaceLooks) {
  const Eigen::MatrixX3d light = light_of_order_2();
  Eigen::MatrixX3d intensities = shadowed_transfer() * light;
  std::mt19937 random(3);
  std::normal_distribution<double> noise(1, 0.05);
  for (double& value : intensities.reshaped()) value *= noise(random);
  const Eigen::MatrixX3d found = exact().solve(features_of(intensities));
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(0, -0.6, 0.8)}) {
    const Eigen::Vector3d truth = sh::irradiance(light, normal);
    // A hundred points of 5 % for nine numbers.
    EXPECT_LT((sh::irradiance(found, normal) - truth).cwiseAbs().maxCoeff(), 0.05 * truth.maxCoeff());
  }
}

TEST(RadianceTransfer, PointsThatVaryMoreCountLess) {
  const Eigen::MatrixX3d light = light_of_order_2();
  Eigen::MatrixX3d intensities = shadowed_transfer() * light;
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(kFeatureCells, 0.01);
  for (int j = 0; j < kFeatureCells; ++j) {
    if (cells().direction(j).y() < 0.5F) continue;
    intensities.row(j) *= 0.3;  // hair
    variance[j] = 10;
  }
  const Eigen::VectorXf features = features_of(intensities);
  const RadianceTransfer wary(shadowed_transfer(), variance);
  EXPECT_LT((wary.solve(features, 1e-9) - light).norm(), 0.2 * (exact().solve(features, 1e-9) - light).norm());
}

TEST(RadianceTransfer, GreyInGreyOutAndNothingForNothing) {
  Eigen::MatrixX3d light = light_of_order_2();
  light.col(0) = light.col(2) = light.col(1);
  const Eigen::MatrixX3d found = exact().solve(features_of(shadowed_transfer() * light));
  EXPECT_EQ(found.col(0), found.col(1));
  EXPECT_EQ(found.col(2), found.col(1));
  EXPECT_TRUE(exact().solve(Eigen::VectorXf::Zero(kFaceFeatures)).isZero());
}

// Skin of shading 2 that mirrors .5: over the level 1, and .25 over the skin's albedo on top.
TEST(RadianceTransfer, IntensitiesHoldShadingAndHighlight) {
  Observations face = testing::ellipsoid_face();
  face.shading.setConstant(2);
  face.highlight.setConstant(0.5F);
  const Eigen::MatrixX4f points = point_intensities(face_features(face));
  const int front = cells().cell_of({0, 0, 1});
  EXPECT_NEAR(points(front, 1), 1 + 0.25F / kSkinLuminance, 1e-4F);
  EXPECT_GT(points(front, 3), 0.5F);
  EXPECT_LT(points(cells().cell_of({0, 0, -1}), 3), 1e-3F);
}

class Learning : public ::testing::Test {
 protected:
  // A few lamps anywhere and a surround, and what the transfer makes of them; intensities below 0, which order 2 rings to, are no photo.
  void teach(RadianceTransferLearner& learner, int photos, double noise) {
    std::normal_distribution<double> texture(1, noise);
    std::uniform_real_distribution<double> uniform(0, 1);
    while (learner.examples() < photos) {
      Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(kFeatureCells, 3, 1);
      for (int lamp = 0; lamp < 3; ++lamp)
        light.row(static_cast<int>(uniform(random_) * kFeatureCells)).array() +=
            static_cast<float>(20 * uniform(random_));
      const Eigen::MatrixX3d terms =
          cells().cell_solid_angle() * harmonics_at_cells().transpose() * light.cast<double>();
      Eigen::MatrixX3d intensities = shadowed_transfer() * terms;
      if (intensities.minCoeff() < 0) continue;
      for (int j = 0; j < kFeatureCells; ++j) intensities.row(j) *= std::max(0.0, texture(random_));
      learner.add(features_of(intensities), light);
    }
  }
  double worst(const RadianceTransfer& found) const {
    double most = 0;
    for (int j = 0; j < kFeatureCells; ++j) {
      if (cells().direction(j).z() > 0.1F)
        most = std::max(most, (found.transfer().row(j) - shadowed_transfer().row(j)).cwiseAbs().maxCoeff());
    }
    return most;
  }

  std::mt19937 random_{5};
};

TEST_F(Learning, FindsTheTransfer) {
  RadianceTransferLearner learner;
  teach(learner, 60, 0);
  const RadianceTransfer found = learner.learn(1e-6);
  EXPECT_LT(worst(found), 1e-3);
  EXPECT_LT(found.variance()[cells().cell_of({0, 0, 1})], 1e-3);
  // Nobody saw the back of a head.
  EXPECT_TRUE(found.transfer().row(cells().cell_of({0, 0, -1})).isZero());
}

TEST_F(Learning, AveragesTextureAndSaysHowMuchThereIs) {
  RadianceTransferLearner learner;
  teach(learner, 400, 0.1);
  const RadianceTransfer found = learner.learn();
  EXPECT_LT(worst(found), 0.06);  // of about .3; 800 photos of 10 %, weakest in the terms that few lamps tell apart
  EXPECT_GT(found.variance()[cells().cell_of({0, 0, 1})], 1e-3);
}

// A sun behind the head: over the face's brightness it is huge.
TEST_F(Learning, OnePhotoOfHugeLightIsOnePhoto) {
  RadianceTransferLearner learner;
  teach(learner, 200, 0);
  Eigen::MatrixX3f light = Eigen::MatrixX3f::Constant(kFeatureCells, 3, 1);
  light.row(cells().cell_of({0.1F, 0.5F, -1})).setConstant(1e5F);
  learner.add(features_of(Eigen::MatrixX3d::Ones(kFeatureCells, 3)), light);
  EXPECT_LT(worst(learner.learn(1e-6)), 0.05);
}

TEST_F(Learning, BothSidesOfAFaceAreAlike) {
  RadianceTransferLearner learner;
  teach(learner, 30, 0.1);
  const RadianceTransfer found = learner.learn();
  const Eigen::VectorXf features = features_of(shadowed_transfer() * light_of_order_2());
  const Eigen::MatrixX3d here = found.solve(features);
  const Eigen::MatrixX3d there = found.solve(mirrored_features(features));
  for (const Eigen::Vector3d& normal : {Eigen::Vector3d(0.6, 0, 0.8), Eigen::Vector3d(-0.5, 0.5, 0.7)}) {
    const Eigen::Vector3d other(-normal.x(), normal.y(), normal.z());
    EXPECT_LT((sh::irradiance(here, normal) - sh::irradiance(there, other)).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(RadianceTransfer, RefusesWhatDoesNotFit) {
  EXPECT_THROW(point_intensities(Eigen::VectorXf::Zero(7)), std::invalid_argument);
  EXPECT_THROW(RadianceTransfer(Eigen::MatrixXd::Zero(5, 9), Eigen::VectorXd::Ones(5)), std::invalid_argument);
  EXPECT_THROW(RadianceTransfer(shadowed_transfer(), Eigen::VectorXd::Zero(kFeatureCells)), std::invalid_argument);
  EXPECT_THROW(exact().solve(Eigen::VectorXf::Zero(kFaceFeatures), 0), std::invalid_argument);
  RadianceTransferLearner learner;
  EXPECT_THROW(learner.add(Eigen::VectorXf::Zero(kFaceFeatures), Eigen::MatrixX3f::Zero(3, 3)), std::invalid_argument);
  EXPECT_THROW(learner.learn(0), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting
