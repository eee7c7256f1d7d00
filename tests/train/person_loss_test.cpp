#include "train/person_loss.h"

#include "faceprobe/core/random.h"
#include "train/small_person.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <stdexcept>

namespace faceprobe::train {
namespace {

using testing::kCrop;
using testing::make_person;
using testing::Person;

std::vector<Image> black(const Person& person) {
  std::vector<Image> layers;
  for (const PersonPhoto& photo : person.photos) layers.emplace_back(photo.linear.width(), photo.linear.height(), 3);
  return layers;
}

TEST(PersonLoss, IsSmallForTheTrueLayersAndLargeForNone) {
  const Person person = make_person();
  const PersonPhotos photos(person.photos, person.regions, {.guard_weight = 0});
  EXPECT_GT(photos.pixels(), 300);
  const PersonLoss none = photos.loss(black(person));
  const PersonLoss right = photos.loss(person.highlights);
  EXPECT_GT(none.residual, 0.005);
  EXPECT_LT(right.residual, 0.05 * none.residual);  // what is left comes of sampling the three photos at other places
  EXPECT_EQ(none.energy, 0);
  EXPECT_GT(right.energy, 0.005);
}

TEST(PersonLoss, KeepsTheEnergyThatIsTrusted) {
  const Person person = make_person();
  const PersonPhotos photos(person.photos, person.regions, {.energy_weight = 0.4});
  const PersonLoss right = photos.loss(person.highlights);
  EXPECT_EQ(right.kept, 0);  // nothing to compare with
  EXPECT_EQ(photos.loss(person.highlights, right.measures).kept, 0);
  std::vector<Image> halves = person.highlights;
  for (Image& layer : halves)
    for (float& value : layer.values()) value *= 0.5F;
  EXPECT_NEAR(photos.loss(halves, right.measures).kept, 0.4 * 0.25, 1e-6);  // layers are floats
  EXPECT_NEAR(photos.loss(halves, right.measures).residual, photos.loss(halves).residual, 1e-12);
}

// Lips, beard and blush have gone into the highlight: rank one, and wrong.
TEST(PersonLoss, ADiffuseLayerOfOneColourIsPenalised) {
  const Person person = make_person();
  const PersonLossOptions options{.guard_weight = 0.1};
  const PersonPhotos photos(person.photos, person.regions, options);
  const PersonLoss before = photos.loss(black(person));
  std::vector<Image> taken;  // leaves as much of one colour as every channel of the photo has
  for (const PersonPhoto& photo : person.photos) {
    Image layer = photo.linear;
    const float colour[3] = {0.6F, 0.4F, 0.3F};
    for (std::size_t i = 0; i < layer.pixel_count(); ++i) {
      float* pixel = layer.data() + 3 * i;
      const float level = std::min({pixel[0] / colour[0], pixel[1] / colour[1], pixel[2] / colour[2]});
      for (int c = 0; c < 3; ++c) pixel[c] -= level * colour[c];
    }
    taken.push_back(std::move(layer));
  }
  const PersonLoss unguarded = photos.loss(taken);
  EXPECT_LT(unguarded.residual, 0.01 * before.residual) << "the low-rank loss likes it";
  // Each photo's guard is 1 there but for floats' rounding, 1e-7 of a chromaticity whose deviation is 1e-2.
  const LayerMeasures trusted{.energies = {}, .chroma_variances = before.measures.chroma_variances};
  const PersonLoss guarded = photos.loss(taken, trusted);
  EXPECT_NEAR(guarded.guards - unguarded.guards, 3 * options.guard_weight, 1e-3);
  // Highlights that a network missed add to the variance that is trusted; to find them all is no step towards one colour.
  EXPECT_EQ(photos.loss(person.highlights, trusted).guards, photos.loss(person.highlights).guards);
  // One photo full of missed highlights does not set the measure for the others.
  LayerMeasures odd = photos.loss(person.highlights).measures;
  odd.energies.clear();
  odd.chroma_variances[1] *= 100;
  EXPECT_EQ(photos.loss(person.highlights, odd).guards, photos.loss(person.highlights).guards);
  odd.chroma_variances = {1, 1};
  EXPECT_THROW(photos.loss(taken, odd), std::invalid_argument);
}

// Along random directions in all layers at once, against central differences.
TEST(PersonLoss, GradientAgainstDifferences) {
  const Person person = make_person();
  for (const bool rank1 : {true, false}) {
    const PersonPhotos photos(person.photos, person.regions, {.rank1 = rank1});
    std::vector<Image> at = person.highlights;
    for (Image& layer : at)
      for (float& value : layer.values()) value *= 0.5F;
    // So many colours that the guard against one colour is awake: the true layers' variance is 2e-4.
    const LayerMeasures trusted{.energies = std::vector<double>(at.size(), 0.02),
                                .chroma_variances = std::vector<double>(at.size(), 1e-2)};
    const PersonLoss here = photos.loss(at, trusted);
    Random random({5});
    for (int trial = 0; trial < 3; ++trial) {
      std::vector<Image> ahead = at;
      std::vector<Image> behind = at;
      double expected = 0;
      for (std::size_t k = 0; k < at.size(); ++k) {
        for (std::size_t i = 0; i < at[k].values().size(); ++i) {
          const auto step = static_cast<float>(3e-4 * random.normal());
          ahead[k].data()[i] += step;
          behind[k].data()[i] -= step;
          // What was really stepped, after rounding to float.
          const double stepped =
              0.5 * (static_cast<double>(ahead[k].data()[i]) - static_cast<double>(behind[k].data()[i]));
          expected += stepped * static_cast<double>(here.by_highlight[k].data()[i]);
        }
      }
      const PersonLoss a = photos.loss(ahead, trusted);
      const PersonLoss b = photos.loss(behind, trusted);
      const double found = 0.5 * (a.residual + a.guards + a.kept - b.residual - b.guards - b.kept);
      // Gradients come back as floats, and the loss is curved within the step.
      EXPECT_NEAR(found, expected, 2e-3 * std::abs(expected) + 1e-8);
    }
  }
}

TEST(PersonLoss, WhatOnePhotoDoesNotShowCountsInNone) {
  Person person = make_person();
  const PersonPhotos all(person.photos, person.regions);
  person.photos[1].clipped = ByteImage(kCrop, kCrop, 1);
  for (int y = 0; y < kCrop; ++y)
    for (int x = 0; x < kCrop / 2; ++x) person.photos[1].clipped(x, y) = 1;
  const PersonPhotos half(person.photos, person.regions);
  EXPECT_LT(half.pixels(), 7 * all.pixels() / 10);
  EXPECT_GT(half.pixels(), 2 * all.pixels() / 10);
  const PersonLoss loss = half.loss(black(person));
  for (const Image& gradient : loss.by_highlight) {
    // The right half is all that acts; a blur away from the border nothing is left of it.
    EXPECT_EQ(gradient(kCrop / 2 - 6, 26, 0), 0);
  }
}

TEST(PersonLoss, WrongCallsAreRefused) {
  Person person = make_person();
  EXPECT_THROW(PersonPhotos({person.photos[0]}, person.regions), std::invalid_argument);
  EXPECT_THROW(PersonPhotos(person.photos, person.regions, {.guard_weight = -1}), std::invalid_argument);
  const PersonPhotos photos(person.photos, person.regions);
  EXPECT_THROW(photos.loss(std::vector<Image>(2)), std::invalid_argument);
  EXPECT_THROW(photos.loss(std::vector<Image>(3)), std::invalid_argument);
  person.photos[0].linear = Image(kCrop, kCrop - 1, 3);
  EXPECT_THROW(PersonPhotos(person.photos, person.regions), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train
