#include "faceprobe/synth/fragments.h"

#include "synth/transport/fixtures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace faceprobe::synth {
namespace {

double covered_px(const Fragments& fragments, Material material) {
  double sum = 0;
  for (int i = 0; i < fragments.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (fragments.material[k] == material) sum += static_cast<double>(fragments.coverage[k]);
  }
  return sum;
}

TEST(PinholeCamera, RayGoesThroughTheProjectedPoint) {
  PinholeCamera camera;
  camera.focal_px = 321;
  camera.centre_px = {60, 70};
  const Eigen::Vector3f point(0.1F, -0.2F, -0.9F);
  EXPECT_LE((camera.ray_cam(camera.project(point)) - point.normalized()).norm(), 1e-6F);
  EXPECT_GT(camera.project({0.1F, 0, -1}).x(), 60);  // +x is to the right, +y up in the picture
  EXPECT_LT(camera.project({0, 0.1F, -1}).y(), 70);
}

TEST(Fragments, SilhouetteOfABallHasItsArea) {
  const float radius = 0.1F;
  const float distance = 1.0F;
  const PinholeCamera camera = camera_at(distance, 0.15F, 128);
  const Fragments seen = find_fragments(scene_of({ball(radius, 150)}), camera, {.samples_per_side = 4});
  // A ball's rim is where sight touches it: sin = r / distance, so the disc's radius in the picture is f tan.
  const double rim_px = static_cast<double>(camera.focal_px) * radius / std::sqrt(distance * distance - radius * radius);
  const double area = kPi * rim_px * rim_px;
  // 16 samples in each of some 540 pixels on the rim leave sqrt(540) / 16 / 2 pixels; facets cut (pi / 150)^2 / 3 off the area.
  EXPECT_NEAR(covered_px(seen, Material::kObject), area, 3.0 + area * 2e-4);
}

TEST(Fragments, DescribeThePointTheyShow) {
  const PinholeCamera camera = camera_at(1.0F, 0.15F, 64);
  const Scene scene = scene_of({ball(0.1F, 60, {0.02F, 0.01F, 0})});
  const Fragments seen = find_fragments(scene, camera);
  ASSERT_GT(seen.count(), 1000);
  for (int i = 0; i < seen.count(); ++i) {
    const Eigen::Vector3f position = seen.position.row(i).transpose();
    const Eigen::Vector3f normal = (position - Eigen::Vector3f(0.02F, 0.01F, 0)).normalized();
    const auto k = static_cast<std::size_t>(i);
    if (seen.coverage[k] < 1) continue;  // whole pixels; on the rim means are means
    EXPECT_GT(seen.normal.row(i).dot(normal.transpose()), 0.999F);
    EXPECT_NEAR(seen.weights.row(i).sum(), 1, 1e-5F);
    Eigen::RowVector3f from_vertices = Eigen::RowVector3f::Zero();
    for (int c = 0; c < 3; ++c) from_vertices += seen.weights(i, c) * scene.vertices().row(seen.vertex(i, c));
    EXPECT_LE((from_vertices - seen.position.row(i)).norm(),
              0.006F);  // a pixel is 5 mm on the ball, more where it slopes away
    Eigen::RowVector3f from_all = Eigen::RowVector3f::Zero();
    for (int m = seen.mix_first[k]; m < seen.mix_first[k + 1]; ++m) {
      from_all += seen.mix_weight[static_cast<std::size_t>(m)] *
                  scene.vertices().row(seen.mix_vertex[static_cast<std::size_t>(m)]);
    }
    EXPECT_LE((from_all - seen.position.row(i)).norm(), 1e-6F);  // the mean over the pixel itself
    const Eigen::Vector2f place = camera.project(camera.camera_from_scene * position);
    EXPECT_NEAR(place.x(), static_cast<float>(seen.pixel[k] % 64) + 0.5F, 0.5F);
    EXPECT_NEAR(place.y(), static_cast<float>(seen.pixel[k] / 64) + 0.5F, 0.5F);
    EXPECT_NEAR(seen.depth_m(i), 1.0F - position.z(), 1e-5F);
  }
}

TEST(Fragments, SharesOfAPixelAddUp) {
  // A wall behind everything: every pixel is covered whole, by as many surfaces as it shows.
  SurfaceMesh near_ball = ball(0.03F, 40, {0.01F, 0.02F, 0.2F});
  near_ball.material = Material::kSkin;
  const Scene scene = scene_of({wall(1.0F, 4, -0.3F), ball(0.1F, 60), near_ball});
  const Fragments seen = find_fragments(scene, camera_at(1.0F, 0.15F, 64), {.samples_per_side = 3});
  std::map<int, double> sum;
  int last = 0;
  for (int i = 0; i < seen.count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_GT(seen.coverage[k], 0);
    EXPECT_GE(seen.pixel[k], last);
    last = seen.pixel[k];
    sum[seen.pixel[k]] += static_cast<double>(seen.coverage[k]);
  }
  EXPECT_EQ(sum.size(), 64U * 64U);
  for (const auto& [pixel, share] : sum) EXPECT_NEAR(share, 1, 1e-6) << pixel;
  EXPECT_GT(seen.count(), 64 * 64 + 100);
}

TEST(Fragments, LensesComeOnTopOfWhatTheyCover) {
  SurfaceMesh lens = wall(0.05F, 2, 0.3F);
  lens.material = Material::kLens;
  const PinholeCamera camera = camera_at(1.0F, 0.15F, 60);
  const Fragments without = find_fragments(scene_of({ball(0.1F, 40)}), camera);
  const Fragments with = find_fragments(scene_of({ball(0.1F, 40), lens}), camera);
  EXPECT_NEAR(covered_px(with, Material::kObject), covered_px(without, Material::kObject), 1e-3);
  const double width_px = static_cast<double>(camera.focal_px) * 0.1 / 0.7;
  EXPECT_NEAR(covered_px(with, Material::kLens), width_px * width_px,
              2.0 * width_px / 3.0);  // a third of a pixel on two sides
}

TEST(Fragments, AMeshBeforeItselfIsTwoFragments) {
  SurfaceMesh two = wall(1.0F, 2, -0.2F);
  const SurfaceMesh front = ball(0.05F, 30, {0, 0, 0.1F});
  const Eigen::Index first = two.vertices.rows();
  SurfaceMesh joined = two;
  joined.vertices.resize(first + front.vertices.rows(), 3);
  joined.vertices << two.vertices, front.vertices;
  joined.normals.resize(joined.vertices.rows(), 3);
  joined.normals << two.normals, front.normals;
  joined.triangles.resize(two.triangles.rows() + front.triangles.rows(), 3);
  joined.triangles << two.triangles, front.triangles.array() + static_cast<int>(first);
  const Fragments seen = find_fragments(scene_of({joined}), camera_at(1.0F, 0.1F, 40));
  for (int i = 0; i < seen.count(); ++i) {
    const float z = seen.position(i, 2);
    EXPECT_TRUE(std::abs(z + 0.2F) < 1e-4F || z > 0.05F) << z;  // never in between
  }
}

TEST(Fragments, NormalsFaceTheCamera) {
  const Fragments seen = find_fragments(scene_of({ball(0.1F, 12)}), camera_at(0.5F, 0.12F, 64));
  for (int i = 0; i < seen.count(); ++i) {
    const Eigen::RowVector3f view = Eigen::RowVector3f(0, 0, 0.5F) - seen.position.row(i);
    EXPECT_GT(seen.normal.row(i).dot(view.normalized()), 0.015F);
    EXPECT_NEAR(seen.normal.row(i).norm(), 1, 1e-5F);
  }
}

TEST(Fragments, KnowHowMuchTheSurfaceBendsWithinAPixel) {
  // Looking straight at a ball, normals of a pixel of width w fill a square of w / r radians: variance (w / r)^2 / 12 per axis, and
  // 8 x 8 samples know that to 1 - 1 / 64.
  const PinholeCamera camera = camera_at(1.0F, 0.15F, 33);
  const Fragments seen = find_fragments(scene_of({ball(0.1F, 200)}), camera, {.samples_per_side = 8});
  const auto middle = std::ranges::find(seen.pixel, 16 * 33 + 16) - seen.pixel.begin();
  const float width = (1.0F - 0.1F) / camera.focal_px / 0.1F;
  EXPECT_NEAR(seen.slope_variance(middle), width * width / 12, 0.03F * width * width / 12);
  const Fragments flat = find_fragments(scene_of({wall(1.0F, 4, 0)}), camera);
  EXPECT_LE(flat.slope_variance.maxCoeff(), 1e-6F);
}

TEST(Fragments, DoNotDependOnThreads) {
  const Scene scene = scene_of({ball(0.1F, 40), ball(0.05F, 20, {0.08F, 0, 0.05F})});
  const PinholeCamera camera = camera_at(1.0F, 0.15F, 50);
  const Fragments one = find_fragments(scene, camera, {.threads = 1});
  const Fragments three = find_fragments(scene, camera, {.threads = 3});
  EXPECT_EQ(one.pixel, three.pixel);
  EXPECT_EQ(one.coverage, three.coverage);
  EXPECT_EQ(one.position, three.position);
  EXPECT_EQ(one.vertex, three.vertex);
}

}  // namespace
}  // namespace faceprobe::synth
