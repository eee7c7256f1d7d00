// What the network sees, in the place of the mesh's surface.
#include "pipeline/apply_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace faceprobe::pipeline {
namespace {

constexpr int kSize = 8;

face::FaceGeometry mesh_seen_along(const Eigen::Vector3f& view) {
  face::FaceGeometry geometry;
  geometry.normal_cam = geometry.view_cam = geometry.position_cam_m = Image(kSize, kSize, 3);
  geometry.region = ByteImage(kSize, kSize, 1, static_cast<std::uint8_t>(Region::kCheeks));
  for (std::size_t i = 0; i < geometry.region.pixel_count(); ++i) {
    Eigen::Map<Eigen::Vector3f>(geometry.view_cam.data() + 3 * i) = view;
    Eigen::Map<Eigen::Vector3f>(geometry.normal_cam.data() + 3 * i) = view;
  }
  geometry.region(0, 0) = 0;
  return geometry;
}

Surface surface_of(const Eigen::Vector3f& normal) {
  Surface surface{Image(kSize, kSize, 3), Image(kSize, kSize, 1, 0.1F), Image(kSize, kSize, 3, 1.0F),
                  ByteImage(kSize, kSize, 1, static_cast<std::uint8_t>(Region::kForehead))};
  for (std::size_t i = 0; i < surface.region.pixel_count(); ++i)
    Eigen::Map<Eigen::Vector3f>(surface.normal_cam.data() + 3 * i) = normal;
  surface.region(3, 4) = static_cast<std::uint8_t>(Region::kGlasses);
  return surface;
}

TEST(ApplySurface, TheNetworksAxisIsTheViewOfTheFace) {
  const Eigen::Vector3f view = Eigen::Vector3f(0.3F, -0.2F, 1).normalized();
  face::FaceGeometry geometry = mesh_seen_along(view);
  apply_normals(surface_of(Eigen::Vector3f::UnitZ()), geometry);
  // What faces the network faces the camera.
  EXPECT_LT((Eigen::Vector3f(geometry.normal_cam.pixel(4, 4)) - view).norm(), 1e-5F);
  // What is at 40 degrees to the network is so to the camera.
  const Eigen::Vector3f tilted(std::sin(0.7F), 0, std::cos(0.7F));
  geometry = mesh_seen_along(view);
  apply_normals(surface_of(tilted), geometry);
  EXPECT_NEAR(Eigen::Vector3f(geometry.normal_cam.pixel(4, 4)).dot(view), std::cos(0.7F), 1e-5F);
}

TEST(ApplySurface, GlassesAreNoSkinAndOffTheMeshNothingIs) {
  face::FaceGeometry geometry = mesh_seen_along(Eigen::Vector3f::UnitZ());
  apply_normals(surface_of(Eigen::Vector3f::UnitZ()), geometry);
  EXPECT_EQ(geometry.region(3, 4), static_cast<std::uint8_t>(Region::kCheeks));
  apply_regions(surface_of(Eigen::Vector3f::UnitZ()), geometry);
  EXPECT_EQ(geometry.region(3, 4), static_cast<std::uint8_t>(Region::kGlasses));
  EXPECT_EQ(geometry.region(2, 2), static_cast<std::uint8_t>(Region::kForehead));
  EXPECT_EQ(geometry.region(0, 0), 0);
  EXPECT_EQ(geometry.normal_error_rad(2, 2), 0.1F);
}

TEST(ApplySurface, AlbedoTimesShadingIsTheDiffuseLayer) {
  Surface surface = surface_of(Eigen::Vector3f::UnitZ());
  Image diffuse(kSize, kSize, 3);
  for (std::size_t i = 0; i < diffuse.values().size(); ++i) {
    diffuse.data()[i] = 0.01F * static_cast<float>(i % 37);
    surface.shading.data()[i] = 0.5F + 0.02F * static_cast<float>(i % 3);
  }
  ByteImage skin(kSize, kSize, 1, 1);
  skin(1, 1) = 0;
  const AlbedoShading split = split_diffuse(surface.shading, diffuse, skin);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      for (int c = 0; c < 3; ++c) {
        if (skin(x, y) != 0)
          EXPECT_NEAR(split.albedo(x, y, c) * split.shading(x, y, c), diffuse(x, y, c), 1e-6F);
        else
          EXPECT_EQ(split.shading(x, y, c), 0);
      }
    }
  }
  EXPECT_NEAR(split.light_colour.x(), 0.5F / 0.52F, 1e-5F);
  EXPECT_NEAR(split.light_colour.y(), 1, 1e-6F);
}

}  // namespace
}  // namespace faceprobe::pipeline
