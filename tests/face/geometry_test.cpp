#include "faceprobe/face/geometry.h"

#include "face/fixtures.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"

#include <gtest/gtest.h>
#include <numbers>

namespace faceprobe::face {
namespace {

// A sphere in place of the face: all normals and positions are known.
struct Sphere {
  Eigen::Vector3d centre{0.05, -0.03, -0.8};
  double radius = 0.1;
  CanonicalMesh mesh;
  Face face;

  Sphere() {
    constexpr int kRings = 40;
    constexpr int kSegments = 80;
    face.vertices_cam_m.resize((kRings + 1) * kSegments, 3);
    for (int r = 0; r <= kRings; ++r) {
      for (int s = 0; s < kSegments; ++s) {
        const double polar = kPi * r / kRings;
        const double azimuth = 2 * kPi * s / kSegments;
        const Eigen::Vector3d out(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                  std::sin(polar) * std::cos(azimuth));
        face.vertices_cam_m.row(r * kSegments + s) = (centre + radius * out).cast<float>().transpose();
      }
    }
    mesh.vertices_m = face.vertices_cam_m;
    mesh.triangles.resize(2 * (kRings - 2) * kSegments, 3);
    int t = 0;
    for (int r = 1; r < kRings - 1; ++r) {
      for (int s = 0; s < kSegments; ++s) {
        const int a = r * kSegments + s;
        const int b = r * kSegments + (s + 1) % kSegments;
        mesh.triangles.row(t++) << a, a + kSegments, b;
        mesh.triangles.row(t++) << b, a + kSegments, b + kSegments;
      }
    }
  }
};

const Camera kCamera{500, 320, 240};

TEST(Camera, ProjectAndViewAreInverse) {
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.1, 0.2, -1), Eigen::Vector3d(-0.4, -0.1, -0.5)}) {
    const Eigen::Vector2d px = kCamera.project(point);
    EXPECT_NEAR((kCamera.view_direction(px.x(), px.y()) + point.normalized()).norm(), 0, 1e-12);
  }
  EXPECT_GT(kCamera.project({0.1, 0, -1}).x(), kCamera.centre_x_px) << "+x is right in the photo";
  EXPECT_LT(kCamera.project({0, 0.1, -1}).y(), kCamera.centre_y_px) << "+y is up";
}

TEST(Geometry, SphereHasClosedFormNormalsAndPositions) {
  const Sphere sphere;
  const Crop crop{280, 180, 1.7, 250, 240};
  const FaceGeometry g = rasterize(sphere.face, kCamera, sphere.mesh, crop);
  int inside = 0;
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const Eigen::Vector2d photo = crop.photo_from_crop(x + 0.5, y + 0.5);
      const Eigen::Vector3d view = kCamera.view_direction(photo.x(), photo.y());
      EXPECT_NEAR((Eigen::Vector3f(g.view_cam.pixel(x, y)).cast<double>() - view).norm(), 0, 1e-6);
      const Eigen::Vector3d position = Eigen::Vector3f(g.position_cam_m.pixel(x, y)).cast<double>();
      // Ray from the camera meets the sphere at the nearer root.
      const double along = sphere.centre.dot(-view);
      const double root = along * along - sphere.centre.squaredNorm() + sphere.radius * sphere.radius;
      if (g.region(x, y) == 0) {
        EXPECT_EQ(position, Eigen::Vector3d::Zero());
        continue;
      }
      ++inside;
      ASSERT_GT(root, -1e-5);
      if (root < 0.3 * sphere.radius * sphere.radius) continue;  // towards the outline a facet's sag turns into depth
      const Eigen::Vector3d exact = -view * (along - std::sqrt(root));
      // Half the diagonal of a 4.5 degree cell is 3.2 degrees: it sags by r (1 - cos 3.2 deg) = 0.15 mm, and the ray
      // meets it at 57 degrees at most: 0.28 mm along the ray.
      EXPECT_NEAR((position - exact).norm(), 0, 3e-4);
      // Interpolating unit normals between vertices 4.5 degrees apart is good to a hundredth of that.
      EXPECT_LT(angle_between_deg(Eigen::Vector3f(g.normal_cam.pixel(x, y)).cast<double>(), exact - sphere.centre), 0.3);
    }
  }
  const double apparent = std::asin(sphere.radius / sphere.centre.norm());
  const double area = kPi * std::pow(std::tan(apparent) * kCamera.focal_px * crop.scale, 2);
  EXPECT_NEAR(inside, area, 0.03 * area);  // perspective stretches the disc by a percent here
}

TEST(Geometry, FaceIsSeenFromTheFront) {
  Face face;
  face.camera_from_face = head_pose(20, 5, 0, {0, 0, -0.7});
  face.landmarks_px = projected_landmarks(kCamera, face.camera_from_face);
  face.vertices_cam_m =
      (face.camera_from_face * canonical_mesh().vertices_m.cast<double>().transpose()).transpose().cast<float>();
  const Eigen::RowVector3f low = face.landmarks_px.colwise().minCoeff();
  const Eigen::RowVector3f high = face.landmarks_px.colwise().maxCoeff();
  face.box = {low.x(), low.y(), high.x() - low.x(), high.y() - low.y()};
  GeometryOptions options;
  const Crop crop = face_crop(face, 640, 480, options);
  EXPECT_LE(crop.scale, 1.0);
  const FaceGeometry g = rasterize(face, kCamera, canonical_mesh(), crop);
  EXPECT_EQ(rasterize_regions(face, kCamera, canonical_mesh(), crop), g.region);
  int front = 0;
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      if (g.region(x, y) == 0) continue;
      const Eigen::Vector3f n(g.normal_cam.pixel(x, y));
      EXPECT_NEAR(n.norm(), 1, 1e-5);
      EXPECT_GT(n.dot(Eigen::Vector3f(g.view_cam.pixel(x, y))), -0.35F);  // smoothed normals may lean over at the outline
      EXPECT_LT(g.position_cam_m(x, y, 2), 0);
      ++front;
    }
  }
  EXPECT_GT(front, 0.3 * crop.width * crop.height);
  // The nose points where the head does.
  const Eigen::Vector2d nose =
      crop.crop_from_photo(static_cast<double>(face.landmarks_px(4, 0)), static_cast<double>(face.landmarks_px(4, 1)));
  EXPECT_EQ(g.region(static_cast<int>(nose.x()), static_cast<int>(nose.y())), static_cast<int>(Region::kNose));
}

TEST(Geometry, CropFollowsItsOptions) {
  Face face;
  face.box = {100, 50, 300, 400};
  GeometryOptions options;
  options.long_side_px = 256;
  Crop crop = face_crop(face, 1000, 1000, options);
  EXPECT_EQ(std::max(crop.width, crop.height), 256);
  EXPECT_LE(crop.x_px, 100 - 0.15 * 300);
  EXPECT_GE(crop.photo_from_crop(crop.width, 0).x(), 400 + 0.15 * 300 - 1);
  face.box = {10.3F, 5.6F, 60, 80};
  crop = face_crop(face, 1000, 1000, options);
  EXPECT_EQ(crop.scale, 1) << "small faces are not enlarged";
  EXPECT_EQ(crop.x_px, std::floor(crop.x_px)) << "and their pixels not resampled";
  face.box = {-1e6F, -1e6F, 2e6F, 2e6F};
  crop = face_crop(face, 1000, 1000, options);
  EXPECT_GE(crop.x_px, -500);
  options.long_side_px = 0;
  EXPECT_THROW(face_crop(face, 1000, 1000, options), Error);
  options = {};
  options.margin = std::nan("");
  EXPECT_FALSE(options.validate().empty());
}

// By area, not by a side; and always the same one of equals.
TEST(Face, TheLargestHasTheLargestBox) {
  std::vector<Face> faces(4);
  faces[0].box = {0, 0, 90, 20};
  faces[1].box = {100, 0, 50, 60};
  faces[2].box = {200, 0, 60, 50};
  faces[3].box = {300, 0, 20, 99};
  EXPECT_EQ(&largest_of(faces), &faces[1]);
}

}  // namespace
}  // namespace faceprobe::face
