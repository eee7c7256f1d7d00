#include "train/photo_view.h"

#include "net/close_view.h"
#include "net/torch/picture_tensors.h"
#include "train/small_person.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe::train {
namespace {

using testing::kCrop;

// The face in the middle of the crop, as load_people marks it.
ByteImage middle_mask() {
  ByteImage mask(kCrop, kCrop, 1);
  for (int y = 12; y < 44; ++y) {
    for (int x = 14; x < 42; ++x) mask(x, y) = 1;
  }
  return mask;
}

double largest_difference(const torch::Tensor& square, const Image& expected) {
  double largest = 0;
  for (std::size_t i = 0; i < expected.pixel_count(); ++i) {
    for (int c = 0; c < expected.channels(); ++c) {
      const double found = square[0][c][static_cast<std::int64_t>(i)].item<double>();
      const auto value = static_cast<double>(
          expected.data()[i * static_cast<std::size_t>(expected.channels()) + static_cast<std::size_t>(c)]);
      largest = std::max(largest, std::abs(found - value));
    }
  }
  return largest;
}

TEST(PhotoView, AsItIsIsThePhotoPadded) {
  const testing::Person person = testing::make_person();
  PhotoView view =
      view_of(person.photos[1], middle_mask(), Image(kCrop, kCrop, 3, 0.5F), {.picture_px = 0, .multiple = 32});
  EXPECT_EQ(view.picture.linear.width(), 64);
  EXPECT_EQ(view.mesh.height(), 64);
  EXPECT_EQ(view.skin(20, 20), 1);
  EXPECT_EQ(view.skin(2, 2), 0);
  EXPECT_EQ(view.mesh(60, 60, 0), 0);
  // The padding moves no pixel.
  const torch::Tensor square = in_square(batch_of(view).linear, view.warp);
  EXPECT_LT(largest_difference(square, sample(person.photos[1].linear, person.photos[1].warp)), 1e-6);
}

TEST(PhotoView, TheNearViewShowsTheSameFaceInTheSameSquare) {
  const testing::Person person = testing::make_person();
  const PersonPhoto& photo = person.photos[0];
  PhotoView view = view_of(photo, middle_mask(), Image(kCrop, kCrop, 3), {.picture_px = 80, .multiple = 8});
  ASSERT_EQ(view.picture.linear.width(), 80);
  // The mask, 32 pixels high, fills four fifths.
  EXPECT_EQ(view.skin(40, 10), 1);
  EXPECT_EQ(view.skin(40, 70), 1);
  EXPECT_EQ(view.skin(40, 4), 0);
  // Places that both show have the same colours. They are smooth: interpolation twice changes them by less than a hundredth of their range.
  const torch::Tensor square = in_square(batch_of(view).linear, view.warp);
  const Image expected = sample(photo.linear, photo.warp);
  const ByteImage near = seen(view.warp);
  const ByteImage all = seen(photo.warp);
  int shared = 0;
  for (std::size_t i = 0; i < near.pixel_count(); ++i) {
    EXPECT_LE(near.data()[i], all.data()[i]);
    if (near.data()[i] == 0) continue;
    ++shared;
    EXPECT_NEAR(square[0][1][static_cast<std::int64_t>(i)].item<double>(),
                static_cast<double>(expected.data()[3 * i + 1]), 0.004);
  }
  EXPECT_GT(shared, 200);
}

TEST(PhotoView, ClippedSkinIsNotUsed) {
  PersonPhoto photo = testing::make_person().photos[0];
  photo.clipped = ByteImage(kCrop, kCrop, 1);
  photo.clipped(20, 20) = 2;
  const PhotoView view = view_of(photo, middle_mask(), Image(kCrop, kCrop, 3), {.picture_px = 0, .multiple = 8});
  EXPECT_EQ(view.skin(20, 20), 0);
  EXPECT_EQ(view.skin(21, 20), 1);
}

TEST(InSquare, ItsGradientIsScattered) {
  const PersonPhoto photo = testing::make_person().photos[2];
  torch::manual_seed(4);
  const torch::Tensor layer = torch::rand({1, 1, kCrop, kCrop}).requires_grad_();
  const torch::Tensor by_square = torch::rand({1, 1, testing::kSquare * testing::kSquare});
  (in_square(layer, photo.warp) * by_square).sum().backward();
  Image square(testing::kSquare, testing::kSquare, 1);
  std::copy_n(by_square.data_ptr<float>(), square.values().size(), square.data());
  Image expected = scatter(square, photo.warp);
  EXPECT_LT((layer.grad() - net::tensor_view(expected)).abs().max().item<double>(), 1e-5);
}

}  // namespace
}  // namespace faceprobe::train
