#include "train/frontalise.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/random.h"
#include "faceprobe/face/region.h"
#include "faceprobe/io/data_files.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kSize = 128;
constexpr PhotoSize kPhoto{200, 220};

const face::CanonicalMesh& mesh() {
  static const face::CanonicalMesh loaded = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  return loaded;
}

const FaceTemplate& square_template() {
  static const FaceTemplate square = face_template(mesh(), kSize);
  return square;
}

// The canonical face turned to the photo's right, 900 px to the metre, orthographic, in the middle of the photo.
WarpLandmarks turned(double yaw_deg, double px_per_m = 900) {
  const Eigen::Matrix3f turn =
      Eigen::AngleAxisf(static_cast<float>(radians(yaw_deg)), Eigen::Vector3f::UnitY()).matrix();
  const Eigen::MatrixX3f posed = (mesh().vertices_m.rowwise() - mesh().vertices_m.colwise().mean()) * turn.transpose() *
                                 static_cast<float>(px_per_m);
  WarpLandmarks landmarks{posed.leftCols<2>(), -posed.col(2)};
  landmarks.photo_px.col(0).array() += 100;
  landmarks.photo_px.col(1) = 110 - landmarks.photo_px.col(1).array();
  return landmarks;
}

int count(const Warp& warp, Reach reach) {
  return static_cast<int>(std::count_if(warp.sources.begin(), warp.sources.end(),
                                        [reach](const Source& source) { return source.reach == reach; }));
}

Image noise(int width, int height, int channels, std::uint64_t seed) {
  Random random({seed});
  Image picture(width, height, channels);
  for (float& value : picture.values()) value = static_cast<float>(random.normal());
  return picture;
}

double dot(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    sum += static_cast<double>(a.data()[i]) * static_cast<double>(b.data()[i]);
  return sum;
}

TEST(Frontalise, TheSquareHoldsTheFaceFromTheFront) {
  const FaceTemplate& square = square_template();
  EXPECT_GT(square.positions_px(152, 1), square.positions_px(10, 1)) << "chin below forehead";
  EXPECT_GT(square.positions_px(263, 0), square.positions_px(33, 0)) << "not mirrored";
  // A region per pixel: the corner is not the face.
  const ByteImage regions = template_regions(square, face::triangle_regions(mesh()));
  EXPECT_EQ(regions(0, 0), static_cast<int>(Region::kNone));
  const Eigen::RowVector2i tip = square.positions_px.row(4).cast<int>();
  EXPECT_EQ(regions(tip.x(), tip.y()), static_cast<int>(Region::kNose));
}

TEST(Frontalise, AFaceThatIsTheTemplateStaysWhereItIs) {
  const FaceTemplate& square = square_template();
  EXPECT_NEAR(square.positions_px.col(1).minCoeff(), 0.02 * kSize, 1e-4);
  EXPECT_NEAR(square.positions_px.col(1).maxCoeff(), 0.98 * kSize, 1e-4);
  const Warp warp = face_warp(square, {square.positions_px.cast<float>(), {}}, {kSize, kSize});
  const Image picture = noise(kSize, kSize, 3, 1);
  const Image same = sample(picture, warp);
  int seen_pixels = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      if (seen(warp)(x, y) == 0) continue;
      ++seen_pixels;
      // Three float weights and positions up to 128 px leave about 5e-5 px; the picture changes by up to 8 per pixel.
      EXPECT_NEAR(same(x, y, 1), picture(x, y, 1), 1e-3F);
    }
  }
  EXPECT_GT(seen_pixels, kSize * kSize / 3);
}

TEST(Frontalise, LinearPicturesAreReproducedAtTheLandmarks) {
  // A photo whose values are its own coordinates says where each pixel was read.
  Image coordinates(kPhoto.width, kPhoto.height, 2);
  for (int y = 0; y < kPhoto.height; ++y) {
    for (int x = 0; x < kPhoto.width; ++x) {
      coordinates(x, y, 0) = static_cast<float>(x) + 0.5F;
      coordinates(x, y, 1) = static_cast<float>(y) + 0.5F;
    }
  }
  const WarpLandmarks landmarks = turned(20);
  const Warp warp = face_warp(square_template(), landmarks, kPhoto);
  const Image read = sample(coordinates, warp);
  int checked = 0;
  for (Eigen::Index i = 0; i < 468; ++i) {
    const Eigen::RowVector2d at = square_template().positions_px.row(i);
    const int x = std::min(static_cast<int>(at.x()), kSize - 1);
    const int y = std::min(static_cast<int>(at.y()), kSize - 1);
    if (seen(warp)(x, y) == 0) continue;
    ++checked;
    // The pixel's centre is up to .7 px of the square from the landmark, and the square's pixel is at most about 3 of
    // the photo's here.
    EXPECT_NEAR(read(x, y, 0), landmarks.photo_px(i, 0), 2.5F);
    EXPECT_NEAR(read(x, y, 1), landmarks.photo_px(i, 1), 2.5F);
  }
  EXPECT_GT(checked, 300);
  for (std::size_t i = 0; i < warp.sources.size(); ++i) {
    if (warp.sources[i].reach != Reach::kSeen) continue;
    ASSERT_NEAR(read.data()[2 * i], warp.sources[i].x_px, 1e-4F) << "bilinear reading of a linear picture is exact";
    ASSERT_NEAR(read.data()[2 * i + 1], warp.sources[i].y_px, 1e-4F);
  }
}

TEST(Frontalise, TrianglesTurnedAwayAreOccluded) {
  // The turn of each triangle is known; the threshold is cos = 1/3 of the triangles that face the camera, whose own
  // cosine is .95 to 1.
  const double yaw = 40;
  WarpLandmarks landmarks = turned(yaw);
  landmarks.depth_px.resize(0);
  const Warp warp = face_warp(square_template(), landmarks, kPhoto);
  const Eigen::RowVector3f view(static_cast<float>(-std::sin(radians(yaw))), 0,
                                static_cast<float>(std::cos(radians(yaw))));
  int away = 0;
  int facing = 0;
  for (std::size_t i = 0; i < warp.sources.size(); ++i) {
    const int t = square_template().pixels[i].triangle;
    if (t < 0) continue;
    const Eigen::RowVector3f a =
        mesh().vertices_m.row(mesh().triangles(t, 1)) - mesh().vertices_m.row(mesh().triangles(t, 0));
    const Eigen::RowVector3f b =
        mesh().vertices_m.row(mesh().triangles(t, 2)) - mesh().vertices_m.row(mesh().triangles(t, 0));
    const float cosine = a.cross(b).normalized().dot(view);
    if (cosine < 0.3F) {
      ++away;
      EXPECT_EQ(warp.sources[i].reach, Reach::kOccluded) << cosine;
    } else if (cosine > 0.34F) {
      ++facing;
      EXPECT_EQ(warp.sources[i].reach, Reach::kSeen) << cosine;
    }
  }
  EXPECT_GT(away, 1000);
  EXPECT_GT(facing, 4000);
}

TEST(Frontalise, AForeshorteningLimitIsAnOption) {
  const WarpLandmarks landmarks = turned(50);
  const int strict = count(face_warp(square_template(), landmarks, kPhoto, {.max_foreshortening = 1.5F}), Reach::kSeen);
  const int lenient = count(face_warp(square_template(), landmarks, kPhoto, {.max_foreshortening = 20}), Reach::kSeen);
  EXPECT_LT(strict, lenient * 9 / 10);
  EXPECT_GT(strict, 1000);
}

TEST(Frontalise, DepthTellsWhatIsBehindTheNose) {
  const WarpOptions lenient{.max_foreshortening = 20};  // so that only covering counts
  WarpLandmarks landmarks = turned(50);
  const Warp with = face_warp(square_template(), landmarks, kPhoto, lenient);
  landmarks.depth_px.resize(0);
  const Warp without = face_warp(square_template(), landmarks, kPhoto, lenient);
  int hidden = 0;
  for (std::size_t i = 0; i < with.sources.size(); ++i) {
    if (with.sources[i].reach == without.sources[i].reach) continue;
    ++hidden;
    EXPECT_EQ(with.sources[i].reach, Reach::kOccluded);
    // Turned to the photo's right, the half of the face at +x is the far one; only it can be behind the nose.
    EXPECT_GT(static_cast<int>(i) % kSize, kSize / 2);
  }
  EXPECT_GT(hidden, 30);
  // From the front nothing of the face is behind another part.
  landmarks = turned(0);
  const int frontal = count(face_warp(square_template(), landmarks, kPhoto, lenient), Reach::kSeen);
  landmarks.depth_px.resize(0);
  EXPECT_EQ(frontal, count(face_warp(square_template(), landmarks, kPhoto, lenient), Reach::kSeen));
}

TEST(Frontalise, AMirroredFaceIsSeenFromInside) {
  WarpLandmarks landmarks = turned(0);
  landmarks.photo_px.col(0) = 200 - landmarks.photo_px.col(0).array();
  landmarks.depth_px.resize(0);
  const Warp warp = face_warp(square_template(), landmarks, kPhoto);
  // The few triangles around the rim that faced away now face the camera; they are the measure of themselves.
  EXPECT_LT(count(warp, Reach::kSeen), kSize * kSize / 50);
}

TEST(Frontalise, PartsBeyondThePhotoAreMarked) {
  const WarpLandmarks landmarks = turned(0);
  const PhotoSize half{100, 220};
  const Warp warp = face_warp(square_template(), landmarks, half);
  EXPECT_GT(count(warp, Reach::kOffPhoto), 2000);
  const Image ones = sample(Image(half.width, half.height, 1, 1.0F), warp);
  for (std::size_t i = 0; i < warp.sources.size(); ++i) {
    // The four weights of a pixel add up to 1, in float.
    EXPECT_NEAR(ones.data()[i], warp.sources[i].reach == Reach::kSeen ? 1.0F : 0.0F, 1e-6F);
  }
}

TEST(Frontalise, ScatterIsTheTransposeOfSample) {
  const Warp warp = face_warp(square_template(), turned(30), {90, 220});  // some of it off the photo
  const Image photo = noise(90, 220, 3, 2);
  const Image square = noise(kSize, kSize, 3, 3);
  const double forward = dot(sample(photo, warp), square);
  const double backward = dot(photo, scatter(square, warp));
  const double size = std::sqrt(dot(square, square));  // the standard deviation of what each should be
  EXPECT_NEAR(forward, backward, 1e-5 * size);         // float's rounding of 1e-7 per pixel
  EXPECT_GT(std::abs(forward), 1e-2 * size);
}

TEST(Frontalise, RefusesWhatDoesNotFit) {
  EXPECT_THROW(face_template(mesh(), 4), std::invalid_argument);
  WarpLandmarks landmarks = turned(0);
  EXPECT_THROW(face_warp(square_template(), landmarks, {0, 10}), std::invalid_argument);
  EXPECT_THROW(face_warp(square_template(), landmarks, kPhoto, {.max_foreshortening = 1}), std::invalid_argument);
  EXPECT_THROW(face_warp(square_template(), {landmarks.photo_px.topRows(68), {}}, kPhoto), std::invalid_argument);
  const Warp warp = face_warp(square_template(), landmarks, kPhoto);
  EXPECT_THROW(sample(Image(10, 10, 3), warp), std::invalid_argument);
  EXPECT_THROW(scatter(Image(10, 10, 3), warp), std::invalid_argument);
  landmarks.photo_px(3, 0) = std::numeric_limits<float>::infinity();
  EXPECT_THROW(face_warp(square_template(), landmarks, kPhoto), std::invalid_argument);
  EXPECT_THROW(template_regions(square_template(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace faceprobe::train
