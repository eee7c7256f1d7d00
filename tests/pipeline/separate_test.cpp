// Estimator::separate: the layers at the photo's own size.

#include "pipeline/portrait.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace faceprobe::pipeline {
namespace {

using testing::portrait;
using testing::twice_side_by_side;

// Whether any value inside the rectangle is other than 0.
bool touched(const Image& image, float x0, float y0, float x1, float y1) {
  for (int y = std::max(0, static_cast<int>(y0)); y < std::min(image.height(), static_cast<int>(y1)); ++y) {
    for (int x = std::max(0, static_cast<int>(x0)); x < std::min(image.width(), static_cast<int>(x1)); ++x) {
      for (int c = 0; c < image.channels(); ++c) {
        if (image(x, y, c) != 0.0F) return true;
      }
    }
  }
  return false;
}

void expect_layers_of(const io::Photo& photo, const highlight::Layers& layers, const std::vector<face::Face>& faces) {
  ASSERT_TRUE(layers.highlight.same_size(photo.linear));
  ASSERT_TRUE(layers.diffuse.same_size(photo.linear));
  int outside = 0;
  for (int y = 0; y < photo.linear.height(); ++y) {
    for (int x = 0; x < photo.linear.width(); ++x) {
      const bool in_a_box = std::any_of(faces.begin(), faces.end(), [&](const face::Face& f) {
        const auto px = static_cast<float>(x);
        const auto py = static_cast<float>(y);
        return px >= f.box.x - 1 && px <= f.box.x + f.box.width + 1 && py >= f.box.y - 1 &&
               py <= f.box.y + f.box.height + 1;
      });
      for (int c = 0; c < 3; ++c) {
        ASSERT_GE(layers.highlight(x, y, c), 0.0F);
        ASSERT_NEAR(layers.highlight(x, y, c) + layers.diffuse(x, y, c), photo.linear(x, y, c), 1e-6F);
        if (in_a_box) continue;
        ++outside;
        ASSERT_EQ(layers.highlight(x, y, c), 0.0F) << x << ' ' << y;
        ASSERT_EQ(layers.diffuse(x, y, c), photo.linear(x, y, c)) << x << ' ' << y;
      }
    }
  }
  EXPECT_GT(outside, 0);
  for (const face::Face& f : faces) {
    EXPECT_TRUE(touched(layers.highlight, f.box.x, f.box.y, f.box.x + f.box.width, f.box.y + f.box.height));
  }
}

TEST(Separate, HighlightsAreOnTheFaceAndThePhotoIsUntouchedElsewhere) {
  const Estimator estimator;
  expect_layers_of(portrait(), estimator.separate(portrait()), estimator.find_faces(portrait()));
}

TEST(Separate, EveryFaceOfAPhoto) {
  const Estimator estimator;
  const io::Photo two = twice_side_by_side(portrait());
  const std::vector<face::Face> faces = estimator.find_faces(two);
  ASSERT_EQ(faces.size(), 2U);
  expect_layers_of(two, estimator.separate(two), faces);
}

TEST(Separate, AFaceThatThePhotoCuts) {
  // The right half of the face alone: the crop ends at the photo's border.
  const face::Box box = testing::portrait_estimate().faces[0].face.box;
  const int left = static_cast<int>(box.x + 0.4F * box.width);
  io::Photo half = portrait();
  half.linear = Image(portrait().linear.width() - left, portrait().linear.height(), 3);
  half.clipped = ByteImage(half.linear.width(), half.linear.height(), 1);
  for (int y = 0; y < half.linear.height(); ++y) {
    std::copy_n(portrait().linear.pixel(left, y), half.linear.row(y).size(), half.linear.pixel(0, y));
  }
  EstimateOptions options;
  Eigen::MatrixX2f five(5, 2);
  const Eigen::MatrixX3f& seen = testing::portrait_estimate().faces[0].face.landmarks_px;
  const auto between = [&](int a, int b) { return 0.5F * (seen.row(a) + seen.row(b)).head<2>(); };
  five << between(33, 133), between(362, 263), between(4, 4), between(61, 61), between(291, 291);
  five.col(0).array() -= static_cast<float>(left);
  options.landmarks_px = five;
  const Estimator estimator(options);
  expect_layers_of(half, estimator.separate(half), estimator.find_faces(half));
}

}  // namespace
}  // namespace faceprobe::pipeline
