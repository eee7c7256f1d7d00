#include "faceprobe/lighting/shared_skin.h"

#include "faceprobe/lighting/albedo.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace faceprobe::lighting {
namespace {

// Of luminance about .35, log(r/g) and log(b/g) as given.
Eigen::Vector3f albedo_of(double red, double blue) {
  return Eigen::Vector3d(0.3 * std::exp(red), 0.3, 0.3 * std::exp(blue)).cast<float>();
}

SkinReading reading_of(double red, double blue, std::optional<double> deviation = {}) {
  SkinReading reading;
  reading.albedo = albedo_of(red, blue);
  reading.log_deviation = deviation;
  return reading;
}

Eigen::Vector2d chroma_of(const Eigen::Vector3f& colour) {
  const Eigen::Array3d log = colour.cast<double>().array().log();
  return {log[0] - log[1], log[2] - log[1]};
}

// One person in three lights, each photo's split off by an error of its own: what remains in the lights is the errors' mean.
TEST(SharedSkin, ErrorsOfSinglePhotosAverageOut) {
  std::mt19937 random(3);
  std::normal_distribution<double> skin(0, 0.2);
  std::normal_distribution<double> lamp(0, 0.3);
  std::normal_distribution<double> error(0, 0.1);
  double alone = 0;
  double together = 0;
  for (int person = 0; person < 300; ++person) {
    const Eigen::Vector2d truth(0.8 + skin(random), -0.5 + skin(random));
    std::vector<SkinReading> readings;
    std::vector<Eigen::Vector2d> lights;  // as the photos have them
    std::vector<Eigen::Vector2d> true_lights;
    for (int photo = 0; photo < 3; ++photo) {
      const Eigen::Vector2d off(error(random), error(random));
      readings.push_back(reading_of(truth[0] + off[0], truth[1] + off[1], 0.1));
      true_lights.emplace_back(lamp(random), lamp(random));
      lights.emplace_back(true_lights.back() - off);
    }
    const SharedSkin shared = share_skin(readings);
    std::vector<Eigen::Vector2d> corrected;
    for (std::size_t i = 0; i < 3; ++i) {
      corrected.emplace_back(lights[i] + chroma_of(shared.photos[i].gain));
      alone += (lights[i] - true_lights[i]).squaredNorm();
      together += (corrected[i] - true_lights[i]).squaredNorm();
    }
    // Between photos there is no albedo: differences of lights are exact, to the floats of the albedos.
    EXPECT_LT(((corrected[1] - corrected[0]) - (true_lights[1] - true_lights[0])).norm(), 1e-5);
  }
  // 1 / sqrt(3) = .577, and a few percent that robustness costs; of 1800 errors the ratio is good to 3 %.
  EXPECT_GT(std::sqrt(together / alone), 0.54);
  EXPECT_LT(std::sqrt(together / alone), 0.63);
}

TEST(SharedSkin, OnePhotoAndPhotosThatAgreeKeepTheirLight) {
  for (const bool has_prior : {false, true}) {
    SkinReading own = reading_of(1.0, -0.7, 0.1);
    own.has_prior = has_prior;
    own.region_albedo[3] = albedo_of(0.9, -0.6);
    const SharedSkin one = share_skin({own});
    ASSERT_EQ(one.photos.size(), 1U);
    EXPECT_TRUE(one.photos[0].gain.isOnes(1e-5F)) << has_prior;
    EXPECT_TRUE(one.photos[0].region_gain[3].isOnes(1e-5F)) << has_prior;
    EXPECT_TRUE(one.albedo.isApprox(own.albedo, 1e-5F)) << has_prior;
    EXPECT_NEAR(one.log_deviation, 0.1, 1e-6) << has_prior;
    const SharedSkin two = share_skin({own, own});
    EXPECT_EQ(two.photos[0].gain, two.photos[1].gain) << has_prior;
    // Two that agree know better than one, and lean on the prior less.
    EXPECT_LT(two.log_deviation, 0.1) << has_prior;
    EXPECT_EQ(two.photos[0].gain.isOnes(1e-5F), !has_prior);
  }
}

// The posterior of one skin under the prior and several white balances, which is known in closed form.
TEST(SharedSkin, APriorCountsOnceAndNotOnceAPhoto) {
  const SkinColourPrior prior = skin_colour_prior();
  const double balance = 0.12;
  const double usual = 1 / (prior.deviation * prior.deviation);
  const double seen = 1 / (balance * balance);
  const Eigen::Vector2d skin = prior.log_ratio.matrix() + Eigen::Vector2d(0.3, -0.25);
  std::vector<SkinReading> readings;
  Eigen::Vector2d sum = usual * prior.log_ratio.matrix();
  Eigen::Vector2d plain = Eigen::Vector2d::Zero();
  for (const double light : {0.05, -0.02, -0.04, 0.06}) {  // all within what Huber's estimate takes whole
    const Eigen::Vector2d found = skin + Eigen::Vector2d(light, -light);
    const Eigen::Vector2d own = (usual * prior.log_ratio.matrix() + seen * found) / (usual + seen);
    readings.push_back(reading_of(own[0], own[1], 1 / std::sqrt(usual + seen)));
    readings.back().has_prior = true;
    sum += seen * found;
    plain += own / 4;
  }
  const SharedSkin shared = share_skin(readings);
  const Eigen::Vector2d wanted = sum / (usual + 4 * seen);
  EXPECT_LT((chroma_of(shared.albedo) - wanted).norm(), 1e-5);
  EXPECT_NEAR(shared.log_deviation, 1 / std::sqrt(usual + 4 * seen), 1e-6);
  // Their plain mean is drawn to the usual skin much more.
  EXPECT_LT((wanted - skin).norm(), 0.04);
  EXPECT_GT((plain - skin).norm(), 0.06);
}

TEST(SharedSkin, MoreCertainPhotosSayMoreAndOutliersLess) {
  const SharedSkin weighed = share_skin({reading_of(1.0, -0.5, 0.05), reading_of(1.1, -0.5, 0.1)});
  EXPECT_NEAR(chroma_of(weighed.albedo)[0], 1.0 + 0.1 * 1 / (1 + 4), 1e-5);
  // Ten deviations off: it pulls with the force of two, which moves two others by one deviation, where a mean would go by 3.3.
  const SharedSkin doubted =
      share_skin({reading_of(0.98, -0.5, 0.1), reading_of(1.02, -0.5, 0.1), reading_of(2.0, -0.5, 0.1)});
  EXPECT_NEAR(chroma_of(doubted.albedo)[0], 1.1, 1e-4);
  EXPECT_EQ(doubted.photos[0].trust, 1);
  EXPECT_NEAR(doubted.photos[2].trust, 2.0 / 9, 1e-3);
  EXPECT_GT(doubted.log_deviation, 0.1 / std::sqrt(2.0)) << "they disagree by more than they state";
}

TEST(SharedSkin, EveryRegionHasOneAlbedoInAllPhotos) {
  std::vector<SkinReading> readings;
  for (const double chin : {0.9, 0.95, 0.8}) {
    SkinReading reading = reading_of(0.9 + 0.3 * chin, -0.5);
    reading.region_albedo[5] = (chin * reading.albedo).eval();
    readings.push_back(reading);
  }
  readings[0].region_albedo[7] = albedo_of(0, 0);  // in one photo only: nothing to compare
  const SharedSkin shared = share_skin(readings);
  const Eigen::Vector3f wanted = readings[0].region_albedo[5]->cwiseQuotient(shared.photos[0].region_gain[5]);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const SharedSkin::Photo& photo = shared.photos[i];
    EXPECT_TRUE(readings[i].region_albedo[5]->cwiseQuotient(photo.region_gain[5]).isApprox(wanted, 1e-5F)) << i;
    EXPECT_TRUE(readings[i].albedo.cwiseQuotient(photo.gain).isApprox(shared.albedo, 1e-5F)) << i;
    EXPECT_EQ(photo.region_gain[7], photo.gain) << i;
  }
  EXPECT_TRUE(wanted.isApprox(static_cast<float>(std::cbrt(0.9 * 0.95 * 0.8)) * shared.albedo, 1e-4F));
}

TEST(SharedSkin, AGreyPhotoHasASayInTheLevelAlone) {
  const std::vector<SkinReading> coloured = {reading_of(1.0, -0.5), reading_of(1.2, -0.6)};
  SkinReading grey = reading_of(0, 0);
  grey.albedo *= 2;
  grey.grey = true;
  grey.region_albedo[3] = grey.albedo;
  const SharedSkin shared = share_skin({coloured[0], coloured[1], grey});
  EXPECT_LT((chroma_of(shared.albedo) - chroma_of(share_skin(coloured).albedo)).norm(), 1e-5);
  const Eigen::Vector3f gain = shared.photos[2].gain;
  EXPECT_EQ(gain[0], gain[1]);
  EXPECT_EQ(gain[1], gain[2]);
  EXPECT_GT(gain[0], 1.2F) << "its level was twice the others'";
  EXPECT_EQ(shared.photos[2].region_gain[3], gain);
}

TEST(SharedSkin, OneGainOfHighlights) {
  EXPECT_EQ(shared_gain({}), 1);
  EXPECT_NEAR(shared_gain({1.2, 1 / 1.2}), 1, 1e-12);
  EXPECT_NEAR(shared_gain({0.7, 0.7, 0.7}), 0.7, 1e-12);
  // A photo of powdered skin: a mean of logarithms would be .27.
  EXPECT_GT(shared_gain({1, 1, 0.02}), 0.6);
  EXPECT_THROW(shared_gain({1, 0}), std::invalid_argument);
}

TEST(SharedSkin, RefusesWhatIsNoAlbedo) {
  EXPECT_THROW(share_skin({}), std::invalid_argument);
  SkinReading black = reading_of(1, 0);
  black.albedo[2] = 0;
  EXPECT_THROW(share_skin({black}), std::invalid_argument);
  SkinReading region = reading_of(1, 0);
  region.region_albedo[0] = Eigen::Vector3f(1, std::numeric_limits<float>::infinity(), 1);
  EXPECT_THROW(share_skin({region}), std::invalid_argument);
  EXPECT_THROW(share_skin({reading_of(1, 0, 0.0)}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::lighting
