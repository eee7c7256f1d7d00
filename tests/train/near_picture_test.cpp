// Training's view of a face from near: how large and where the face is, and that every layer goes along.

#include "faceprobe/core/pixel_box.h"
#include "faceprobe/core/region.h"
#include "support/temp_folder.h"
#include "train/augment.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

constexpr int kSize = 80;                    // of the source
constexpr int kSquare = 8;                   // of its chequer
constexpr PixelBox kMesh{18, 34, 42, 66};    // off the middle, and so far inside that no near view looks outside
constexpr int kPicturePx = 60;               // then a near view enlarges: between 1.27 and 1.73
constexpr float kBright = 1.0F;              // clipped, half of it a highlight
constexpr float kDark = 0.04373503F;         // sRGB's 59
const Eigen::Vector3f kTilt(0.6F, 0, 0.8F);  // of the mesh

bool bright(int x, int y) { return (x / kSquare + y / kSquare) % 2 == 0; }

// Every layer shows the same chequer, but for the normals, which tell the place: (u / 2, v / 2, ...), u and v from -1 to 1 to the right and up.
synth::ViewSamples chequer() {
  synth::ViewSamples out;
  synth::Sample sample;
  sample.photo = ByteImage(kSize, kSize, 3, 59);
  sample.clip = ByteImage(kSize, kSize, 1);
  sample.highlight = sample.diffuse = sample.albedo = sample.shading = Image(kSize, kSize, 3);
  sample.environment = EnvMap(4, 2);
  sample.settings_json = "{}";
  out.view.normal = Image(kSize, kSize, 3);
  out.view.depth_m = Image(kSize, kSize, 1);
  out.view.region = out.view.owner = ByteImage(kSize, kSize, 1, 1);
  out.view.faces.resize(1);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const bool is_bright = bright(x, y);
      if (is_bright) {
        std::fill_n(sample.photo.pixel(x, y), 3, std::uint8_t{255});
        sample.clip(x, y) = 7;
        std::fill_n(sample.highlight.pixel(x, y), 3, 0.5F);
      }
      std::fill_n(sample.diffuse.pixel(x, y), 3, is_bright ? 0.5F : 0.05F);
      std::fill_n(sample.albedo.pixel(x, y), 3, 0.5F);
      std::fill_n(sample.shading.pixel(x, y), 3, is_bright ? 1.0F : 0.125F);
      out.view.depth_m(x, y) = is_bright ? 0.5F : 0.75F;
      out.view.region(x, y) = static_cast<std::uint8_t>(is_bright ? Region::kForehead : Region::kHair);
      const auto u = static_cast<float>(2 * x + 1) / kSize - 1;
      const auto v = 1 - static_cast<float>(2 * y + 1) / kSize;
      float* normal = out.view.normal.pixel(x, y);
      normal[0] = u / 2;
      normal[1] = v / 2;
      normal[2] = std::sqrt(1 - (u * u + v * v) / 4);
    }
  }
  out.samples.push_back(std::move(sample));
  return out;
}

class NearPicture : public ::testing::Test {
 protected:
  synth::ShardReader reader_with_mesh(bool found = true) const {
    const std::filesystem::path data = folder_ / (found ? "with" : "without");
    const synth::ShardWriter writer(data, {.size_px = kSize, .environment_height = 2, .recipe = R"({"seed":1})"});
    const std::vector<synth::ViewSamples> views = {chequer()};
    writer.write(0, views);
    writer.finish(1, "");
    synth::FoundMesh mesh{Image(kSize, kSize, 3), ByteImage(kSize, kSize, 1)};
    for (int y = kMesh.top; found && y < kMesh.bottom; ++y) {
      for (int x = kMesh.left; x < kMesh.right; ++x) {
        mesh.region(x, y) = static_cast<std::uint8_t>(Region::kCheeks);
        std::copy_n(kTilt.data(), 3, mesh.normal_cam.pixel(x, y));
      }
    }
    synth::write_meshes(data, 0, std::vector{mesh});
    return synth::ShardReader(data);
  }

  // Nothing happens to the picture beside the near view.
  static TrainConfig config(double close_share) {
    TrainConfig config;
    config.architecture = "face";
    config.picture_px = kPicturePx;
    config.augment = {.mirror = false,
                      .colour_deviation = 0,
                      .exposure_deviation = 0,
                      .grey_share = 0,
                      .no_mask_share = 0,
                      .occluder_share = 0,
                      .zoom_share = 0,
                      .close_share = close_share,
                      .cut_share = 0};
    return config;
  }

  static TrainingPicture drawn(const synth::ShardReader& reader, double close_share, std::uint64_t seed) {
    Random random({seed});
    return draw_picture(reader, 0, config(close_share), random);
  }

  testing::TempFolder folder_;
};

// The longer side of the mesh's box, of the picture's.
double fill(const TrainingPicture& picture) {
  const PixelBox box = box_of(picture.mask).value();
  return std::max(box.width(), box.height()) / static_cast<double>(kPicturePx);
}

// How far the box's middle is from the picture's, the larger of both axes, of the picture's side.
double off_middle(const TrainingPicture& picture) {
  const PixelBox box = box_of(picture.mask).value();
  return 0.5 * std::max(std::abs(box.left + box.right - kPicturePx), std::abs(box.top + box.bottom - kPicturePx)) /
         kPicturePx;
}

constexpr double kPixel = 1.0 / kPicturePx;  // a box of labels ends on a whole pixel

TEST_F(NearPicture, TheMeshFillsFourFifthsOfThePlainOne) {
  const TrainingPicture picture = plain_picture(reader_with_mesh(), 0, config(1));
  EXPECT_EQ(picture.linear.width(), kPicturePx);
  EXPECT_EQ(picture.linear.height(), kPicturePx);
  EXPECT_NEAR(fill(picture), 0.8, kPixel);
  EXPECT_LE(off_middle(picture), kPixel);
}

TEST_F(NearPicture, DrawnOnesDoSoAbout) {
  const synth::ShardReader reader = reader_with_mesh();
  constexpr int kDraws = 200;
  double sum = 0, least = 1, most = 0, farthest = 0;
  for (int seed = 0; seed < kDraws; ++seed) {
    const TrainingPicture picture = drawn(reader, 1, static_cast<std::uint64_t>(seed));
    const double filled = fill(picture);
    sum += filled;
    least = std::min(least, filled);
    most = std::max(most, filled);
    farthest = std::max(farthest, off_middle(picture));
  }
  // The zoom is between .85 and 1.15, the shift up to .06 of the side before it. In 200 draws both come near their ends.
  EXPECT_NEAR(least, 0.8 * 0.85, 2 * kPixel);
  EXPECT_NEAR(most, 0.8 * 1.15, 2 * kPixel);
  EXPECT_NEAR(farthest, 0.06 * 1.15, 2 * kPixel);
  // The zoom's logarithm is even: its mean is .9925, and that of 200 is within .0057, four deviations of them, .0245.
  EXPECT_NEAR(sum / kDraws, 0.8 * 0.9925, 0.8 * 0.0245);
}

TEST_F(NearPicture, AsManyAreNearAsTheShareSays) {
  const synth::ShardReader reader = reader_with_mesh();
  constexpr int kDraws = 200;
  const auto near_of = [&](double share) {
    int count = 0;
    for (int seed = 0; seed < kDraws; ++seed) {
      const double filled = fill(drawn(reader, share, static_cast<std::uint64_t>(seed)));
      if (filled > 0.6)
        ++count;
      else
        EXPECT_NEAR(filled, static_cast<double>(kMesh.height()) / kSize, kPixel);  // the whole picture
    }
    return count;
  };
  EXPECT_EQ(near_of(0), 0);
  EXPECT_NEAR(near_of(0.25), 50, 24);  // four deviations of the binomial distribution, sqrt(200 / 4 * 3 / 4) = 6.1
}

TEST_F(NearPicture, WithoutAMeshThereIsNone) {
  const TrainingPicture picture = drawn(reader_with_mesh(false), 1, 3);
  const TrainingPicture whole = drawn(reader_with_mesh(), 0, 3);
  EXPECT_EQ(picture.region, whole.region);
  EXPECT_TRUE(std::ranges::all_of(picture.mask.values(), [](std::uint8_t m) { return m == 1; }));
}

// Where the normals say that a pixel comes from, there it has its light, labels and depth from too.
TEST_F(NearPicture, AllLayersMoveTogetherAndNormalsKeepTheirLength) {
  const synth::ShardReader reader = reader_with_mesh();
  // More than a pixel of the source away from any place where what is `width` wide begins.
  const auto within = [](double at, int width, int first) {
    const double part = at - first - width * std::floor((at - first) / width);
    return part > 1 && part < width - 1;
  };
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TrainingPicture picture = drawn(reader, 1, seed);
    int judged = 0;
    for (int y = 0; y < kPicturePx; ++y) {
      for (int x = 0; x < kPicturePx; ++x) {
        const Eigen::Map<const Eigen::Vector3f> normal(picture.normal.pixel(x, y));
        // Half precision is good to 5e-4; neighbours are 1 / 80 rad apart, and the chord between them hardly shorter.
        ASSERT_NEAR(normal.norm(), 1, 1e-3F);
        const double from_x = kSize * (0.5 + static_cast<double>(normal.x()));
        const double from_y = kSize * (0.5 - static_cast<double>(normal.y()));
        if (!within(from_x, kSquare, 0) || !within(from_y, kSquare, 0)) continue;
        ++judged;
        const bool is_bright = bright(static_cast<int>(from_x), static_cast<int>(from_y));
        // Weights of equal neighbours sum to 1 within float's rounding; a gain of 1 changes nothing.
        ASSERT_NEAR(picture.linear(x, y, 1), is_bright ? kBright : kDark, 1e-5F) << seed << ' ' << x << ' ' << y;
        ASSERT_NEAR(picture.highlight(x, y, 1), is_bright ? 0.5F : 0.0F, 1e-5F);
        ASSERT_EQ(picture.clip(x, y, 1), is_bright ? 1 : 0);
        ASSERT_EQ(picture.skin(x, y), is_bright ? 1 : 0);
        ASSERT_EQ(picture.region(x, y), static_cast<std::uint8_t>(is_bright ? Region::kForehead : Region::kHair));
        ASSERT_EQ(picture.shading(x, y, 1), is_bright ? 1.0F : 0.125F);
        ASSERT_EQ(picture.depth_m(x, y), is_bright ? 0.5F : 0.75F);  // metres, however near the view is
        const double right = from_x - kMesh.left, down = from_y - kMesh.top;
        const bool inside = right > 1 && right < kMesh.width() - 1 && down > 1 && down < kMesh.height() - 1;
        const bool outside = right < -1 || right > kMesh.width() + 1 || down < -1 || down > kMesh.height() + 1;
        if (!inside && !outside) continue;
        ASSERT_EQ(picture.mask(x, y), inside ? 1 : 0);
        const Eigen::Vector3f mesh(picture.mesh.pixel(x, y));
        ASSERT_NEAR((mesh - (inside ? kTilt : Eigen::Vector3f::Zero())).norm(), 0, 1e-3F);  // half precision
      }
    }
    // Of a square of 8 x 8, 6 x 6 are off its edges: 56 %.
    ASSERT_GT(judged, kPicturePx * kPicturePx / 2);
  }
}

}  // namespace
}  // namespace faceprobe::train
