#include "train/person_loss.h"

#include "faceprobe/core/random.h"
#include "faceprobe/face/region.h"
#include "faceprobe/io/data_files.h"

#include <gtest/gtest.h>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kSquare = 40;
constexpr int kCrop = 56;

struct Person {
  std::vector<PersonPhoto> photos;
  ByteImage regions;
  std::vector<Image> highlights;  // the true ones
};

// One face's colours under three lights of different strength, from slightly different places, with a white highlight in another place
// each time. The colours are smooth, so that sampling does not change them much.
Person make_person() {
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  const FaceTemplate square = face_template(mesh, kSquare, TemplateLayout::kFrontal);
  Person person;
  person.regions = template_regions(square, face::triangle_regions(mesh));
  const Eigen::MatrixX3f centred = mesh.vertices_m.rowwise() - mesh.vertices_m.colwise().mean();
  for (int k = 0; k < 3; ++k) {
    WarpLandmarks landmarks{260.0F * centred.leftCols<2>(), -260.0F * centred.col(2)};
    landmarks.photo_px.col(0).array() += 28.0F + 1.5F * static_cast<float>(k);
    landmarks.photo_px.col(1) = 28.0F - landmarks.photo_px.col(1).array();
    PersonPhoto photo;
    photo.linear = Image(kCrop, kCrop, 3);
    photo.warp = face_warp(square, landmarks, {kCrop, kCrop});
    Image highlight(kCrop, kCrop, 3);
    for (int y = 0; y < kCrop; ++y) {
      for (int x = 0; x < kCrop; ++x) {
        const float face_x = static_cast<float>(x) - 1.5F * static_cast<float>(k);
        const float shade = 0.3F + 0.004F * static_cast<float>(k) * static_cast<float>(x);
        const float red = 0.6F + 0.003F * face_x;
        const float green = 0.4F + 0.002F * static_cast<float>(y);
        const float dx = static_cast<float>(x - 22 - 6 * k);
        const float dy = static_cast<float>(y - 20);
        const float shine = 0.15F * std::exp(-(dx * dx + dy * dy) / 30.0F);
        const float diffuse[3] = {shade * red, shade * green, shade * 0.3F};
        for (int c = 0; c < 3; ++c) {
          highlight(x, y, c) = shine;
          photo.linear(x, y, c) = diffuse[c] + shine;
        }
      }
    }
    person.photos.push_back(std::move(photo));
    person.highlights.push_back(std::move(highlight));
  }
  return person;
}

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

// Along random directions in all layers at once, against central differences.
TEST(PersonLoss, GradientAgainstDifferences) {
  const Person person = make_person();
  for (const bool rank1 : {true, false}) {
    const PersonPhotos photos(person.photos, person.regions, {.rank1 = rank1});
    std::vector<Image> at = person.highlights;
    for (Image& layer : at)
      for (float& value : layer.values()) value *= 0.5F;
    const PersonLoss here = photos.loss(at);
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
      const PersonLoss a = photos.loss(ahead);
      const PersonLoss b = photos.loss(behind);
      const double found = 0.5 * (a.residual + a.guards - b.residual - b.guards);
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
