#include "faceprobe/core/error.h"
#include "faceprobe/face/face.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"

#include "face/fixtures.h"
#include "face/given_landmarks.h"

#include <gtest/gtest.h>

namespace faceprobe::face {
namespace {

const Camera kCamera{700, 320, 240};

const FaceFinder& finder() {
  static const FaceFinder one;
  return one;
}

// Pictures of one or several copies of a public-domain portrait.
const Image& portrait() {
  static const Image photo = io::load_photo(io::data_file("samples/grace_hopper.jpg")).linear;
  return photo;
}
Camera camera_of(const Image& image) {
  return {1.2 * std::max(image.width(), image.height()), image.width() / 2.0, image.height() / 2.0};
}
void paste(Image& onto, const Image& what, int at_x, int at_y) {
  for (int y = 0; y < what.height(); ++y) {
    for (int x = 0; x < what.width(); ++x) {
      for (int k = 0; k < 3; ++k) onto(at_x + x, at_y + y, k) = what(x, y, k);
    }
  }
}

TEST(Finder, FindsAPortrait) {
  const std::vector<Face> faces = finder().find(portrait(), camera_of(portrait()));
  ASSERT_EQ(faces.size(), 1U);
  const Face& face = faces.front();
  EXPECT_GT(face.score, 0.9F);
  EXPECT_FALSE(face.rough_landmarks);
  EXPECT_EQ(face.landmarks_px.rows(), kMeshVertices);
  EXPECT_NEAR(face.landmarks_px.col(2).mean(), 0, 0.1);
  EXPECT_LT(face.landmarks_px(4, 2), face.landmarks_px(234, 2)) << "the nose is nearer than the ear";
  EXPECT_LT(face.reprojection_rms_px, 0.08 * static_cast<double>(face.box.width));
  EXPECT_LT(face.position_m().z(), -0.2);
  for (int i = 0; i < kMeshVertices; ++i) {
    const Eigen::Vector2d px = camera_of(portrait()).project(face.vertices_cam_m.row(i).transpose().cast<double>());
    EXPECT_NEAR((px - face.landmarks_px.row(i).head<2>().transpose().cast<double>()).norm(), 0, 0.01);
  }
}

TEST(Finder, SortsSeveralFacesAndCountsEachOnce) {
  Image wide(3 * portrait().width(), portrait().height(), 3);
  for (int i = 0; i < 3; ++i) paste(wide, portrait(), i * portrait().width(), 0);
  const std::vector<Face> faces = finder().find(wide, camera_of(wide));
  ASSERT_EQ(faces.size(), 3U);
  for (int i = 1; i < 3; ++i) {
    const float step = faces[static_cast<std::size_t>(i)].box.x - faces[static_cast<std::size_t>(i - 1)].box.x;
    // The same pixels seen through another resampling: the network repeats itself to a few percent of the face (200
    // px).
    EXPECT_NEAR(step, portrait().width(), 8);
  }
  FinderOptions options;
  options.max_faces = 2;
  EXPECT_EQ(FaceFinder(options).find(wide, camera_of(wide)).size(), 2U);
}

TEST(Finder, FollowsRollAndExposure) {
  const int width = portrait().width();
  const int height = portrait().height();
  Image turned(height, width, 3);  // a quarter turn clockwise
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int k = 0; k < 3; ++k) turned(height - 1 - y, x, k) = 0.02F * portrait()(x, y, k);
    }
  }
  const std::vector<Face> faces = finder().find(turned, camera_of(turned));
  ASSERT_EQ(faces.size(), 1U);
  const Eigen::RowVector3f eyes = faces[0].landmarks_px.row(263) - faces[0].landmarks_px.row(33);
  EXPECT_GT(eyes.y(), 3 * std::abs(eyes.x())) << "the subject's left eye is below the right one";
}

TEST(Finder, SameForAnyNumberOfThreads) {
  FinderOptions options;
  options.threads = 3;
  Image wide(2 * portrait().width(), 2 * portrait().height(), 3, 0.2F);
  paste(wide, portrait(), 300, 200);
  const std::vector<Face> a = finder().find(wide, camera_of(wide));
  const std::vector<Face> b = FaceFinder(options).find(wide, camera_of(wide));
  ASSERT_EQ(a.size(), 1U);
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(a[0].landmarks_px, b[0].landmarks_px);
  EXPECT_EQ(a[0].vertices_cam_m, b[0].vertices_cam_m);
}

TEST(Finder, SeesNoFaceInNone) {
  EXPECT_TRUE(finder().find(Image(320, 200, 3, 0.5F), kCamera).empty());
  Image stripes(320, 240, 3);
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) stripes(x, y, y % 3) = static_cast<float>((x / 8 + y / 8) % 2);
  }
  EXPECT_TRUE(finder().find(stripes, kCamera).empty());
  EXPECT_TRUE(finder().find(Image(1, 1, 3, 0.5F), kCamera).empty());
}

TEST(Finder, RefusesBadInput) {
  EXPECT_THROW(finder().find(Image(), kCamera), Error);
  EXPECT_THROW(finder().find(Image(10, 10, 2), kCamera), Error);
  EXPECT_THROW(finder().find(Image(10, 10, 3), Camera{}), Error);
  FinderOptions options;
  options.max_faces = 0;
  EXPECT_THROW(FaceFinder{options}, Error);
  options = {};
  options.min_mesh_score = 2;
  EXPECT_FALSE(options.validate().empty());
  options = {};
  options.min_face_px = 0;
  EXPECT_FALSE(options.validate().empty());
  EXPECT_TRUE(FinderOptions{}.validate().empty());
}

TEST(GivenLandmarks, ExactPointsGiveTheRigidFace) {
  const Image grey(640, 480, 3, 0.18F);
  for (const double yaw : {-30.0, 0.0, 20.0}) {
    const Eigen::Isometry3d truth = head_pose(yaw, 5, 10, {0.05, 0.02, -0.6});
    const Eigen::MatrixX3f exact = projected_landmarks(kCamera, truth);
    for (const Eigen::MatrixX2f& given : {projected_five(kCamera, truth), projected_sixty_eight(kCamera, truth)}) {
      const Face face = finder().from_landmarks(grey, kCamera, given);
      EXPECT_TRUE(face.rough_landmarks) << "there is no face in a grey picture";
      EXPECT_EQ(face.score, 1);
      EXPECT_LT(angle_deg(face.camera_from_face, truth), 0.2);  // float pixels
      EXPECT_LT((face.position_m() - truth.translation()).norm(), 0.003);
      EXPECT_LT((face.landmarks_px - exact).leftCols<2>().rowwise().norm().maxCoeff(), 0.5);
      EXPECT_GT(face.box.width, 50);
    }
  }
}

TEST(GivenLandmarks, TheNetworkIsBelievedWhenItAgrees) {
  const Face seen = finder().find(portrait(), camera_of(portrait())).front();
  Eigen::MatrixX2f given(5, 2);
  const auto at = [&](int a, int b) { return 0.5F * (seen.landmarks_px.row(a) + seen.landmarks_px.row(b)).head<2>(); };
  given << at(33, 133), at(362, 263), at(4, 4), at(61, 61), at(291, 291);
  EXPECT_LT(disagreement(seen.landmarks_px, given), 1e-5);
  const Face again = finder().from_landmarks(portrait(), camera_of(portrait()), given);
  EXPECT_FALSE(again.rough_landmarks);
  EXPECT_LT((again.landmarks_px - seen.landmarks_px).leftCols<2>().rowwise().norm().mean(),
            0.03 * static_cast<double>(seen.box.width));
  // Points of a face where there is none.
  given.col(0).array() += 1.5F * seen.box.width;
  EXPECT_TRUE(finder().from_landmarks(portrait(), camera_of(portrait()), given).rough_landmarks);
}

TEST(GivenLandmarks, RefusesOtherNumbersOfPoints) {
  const Image grey(640, 480, 3, 0.18F);
  EXPECT_THROW(finder().from_landmarks(grey, kCamera, Eigen::MatrixX2f::Ones(6, 2)), Error);
  EXPECT_THROW(finder().from_landmarks(grey, kCamera, Eigen::MatrixX2f::Constant(5, 2, std::nanf(""))), Error);
}

}  // namespace
}  // namespace faceprobe::face
