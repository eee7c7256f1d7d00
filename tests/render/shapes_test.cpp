#include "faceprobe/render/shapes.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace faceprobe::render {
namespace {

using Place = std::array<long, 3>;

Eigen::Vector3d corner(const TriangleMesh& mesh, Eigen::Index triangle, int k) {
  return mesh.vertices.row(mesh.triangles(triangle, k)).cast<double>().transpose();
}

Eigen::Vector3d twice_area(const TriangleMesh& mesh, Eigen::Index triangle) {
  const Eigen::Vector3d a = corner(mesh, triangle, 0);
  return (corner(mesh, triangle, 1) - a).cross(corner(mesh, triangle, 2) - a);
}

double signed_volume(const TriangleMesh& mesh) {
  double six_volumes = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    six_volumes += corner(mesh, t, 0).dot(corner(mesh, t, 1).cross(corner(mesh, t, 2)));
  }
  return six_volumes / 6;
}

// Vertices split at an edge lie at one place up to rounding; no neighbours are closer than 4e-4.
Place place_of(const TriangleMesh& mesh, int vertex) {
  Place place{};
  for (int k = 0; k < 3; ++k) place[static_cast<std::size_t>(k)] = std::lround(mesh.vertices(vertex, k) * 131072.0F);
  return place;
}

// Edges that do not have exactly one triangle on each side, or whose two triangles disagree about which side is out.
int open_edges(const TriangleMesh& mesh) {
  std::map<std::pair<Place, Place>, int> uses;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      ++uses[{place_of(mesh, mesh.triangles(t, k)), place_of(mesh, mesh.triangles(t, (k + 1) % 3))}];
    }
  }
  int open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    if (count != 1 || back == uses.end() || back->second != 1) ++open;
  }
  return open;
}

class EveryShape : public ::testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, ::testing::ValuesIn(shape_names()),
                         [](const auto& one) { return one.param; });

TEST_P(EveryShape, CanBeDrawn) {
  const Model model = shape(GetParam());
  EXPECT_EQ(model.validate(), "");
  EXPECT_LE(model.triangle_count(), 60000);
}

TEST_P(EveryShape, StandsOnTheGroundOneHigh) {
  const Eigen::AlignedBox3f box = shape(GetParam()).box();
  EXPECT_NEAR(box.min().y(), 0, 1e-6F);     // rounding of a shift by about 1
  EXPECT_NEAR(box.sizes().y(), 1, 0.05F);   // "about 1 high" in the header
  EXPECT_NEAR(box.center().x(), 0, 0.05F);  // a spout is not as long as a handle, nor are both arms alike
  EXPECT_NEAR(box.center().z(), 0, 0.05F);  // feet and eyes stand out in front
}

TEST_P(EveryShape, FacesOutwards) {
  for (const TriangleMesh& mesh : shape(GetParam()).meshes) {
    EXPECT_GT(signed_volume(mesh), 0);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      const Eigen::Vector3d geometric = twice_area(mesh, t);
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k) mean += mesh.normals.row(mesh.triangles(t, k)).cast<double>().transpose();
      ASSERT_GT(geometric.norm(), 1e-7);  // the smallest, at the poles of the robot's mouth, have 1e-6
      ASSERT_GT(geometric.dot(mean), 0) << "triangle " << t;
    }
  }
}

TEST_P(EveryShape, IsMadeOfClosedSurfaces) {
  for (const TriangleMesh& mesh : shape(GetParam()).meshes) EXPECT_EQ(open_edges(mesh), 0);
}

// Where a surface is smooth, normals of neighbours differ by what the surface bends between them: no seam, no pole stands out.
TEST_P(EveryShape, BendsLittleWithinATriangle) {
  for (const TriangleMesh& mesh : shape(GetParam()).meshes) {
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const auto one = mesh.normals.row(mesh.triangles(t, k));
        const auto two = mesh.normals.row(mesh.triangles(t, (k + 1) % 3));
        // Bends take six steps a quarter: 15 degrees, times root two along a diagonal; a lip may take 1.5 times that.
        ASSERT_GT(one.dot(two), std::cos(radians(32))) << "triangle " << t;
      }
    }
  }
}

TEST(Shapes, SphereIsASphere) {
  const Model model = sphere();
  ASSERT_EQ(model.meshes.size(), 1U);
  const TriangleMesh& mesh = model.meshes[0];
  const Eigen::RowVector3f centre(0, 0.5F, 0);
  const Eigen::MatrixX3f from_centre = mesh.vertices.rowwise() - centre;
  EXPECT_LT((2 * from_centre - mesh.normals).cwiseAbs().maxCoeff(), 1e-6F);  // float rounding
  // An inscribed body with sides h = pi / 64 long: up to h^2 / 8 + h^2 / 8 = 6e-4 radii deep, thrice that of the volume.
  const double ratio = signed_volume(mesh) / (4.0 / 3.0 * kPi * 0.125);
  EXPECT_LT(ratio, 1);
  EXPECT_GT(ratio, 1 - 1.8e-3);
}

TEST(Shapes, CubeHasTheVolumeOfARoundedCube) {
  const Model model = cube();
  ASSERT_EQ(model.meshes.size(), 1U);
  const double r = 0.04;
  const double flat = 1 - 2 * r;
  const double exact = flat * flat * flat + 6 * flat * flat * r + 3 * kPi * flat * r * r + 4.0 / 3.0 * kPi * r * r * r;
  // Steps of 7.5 degrees take h^2 / 6 = 0.3 % of the round parts, which are 1.5 % of the whole.
  EXPECT_NEAR(signed_volume(model.meshes[0]), exact, 6e-5);
}

TEST(Shapes, PotIsNewellsInOutline) {
  const Eigen::AlignedBox3f box = pot().box();
  EXPECT_GT(box.max().x(), -box.min().x());              // the spout, on the right, reaches farther than the handle
  EXPECT_NEAR(box.sizes().z(), 4 / 3.15, 1e-3);          // widest at a radius of 2 where it is 3.15 high; 96 columns
  EXPECT_NEAR(box.sizes().x(), (3 + 3.3) / 3.15, 0.02);  // lips are a little beyond
}

TEST(Shapes, RobotHasEachOfItsMaterials) {
  const Model model = robot();
  std::vector<int> used(model.materials.size(), 0);
  for (const TriangleMesh& mesh : model.meshes) ++used[static_cast<std::size_t>(mesh.material)];
  EXPECT_GE(model.materials.size(), 4U);
  EXPECT_GT(*std::min_element(used.begin(), used.end()), 0);
}

TEST(Shapes, SpheresDoNotTouch) {
  const Model model = three_spheres();
  ASSERT_EQ(model.meshes.size(), 3U);
  EXPECT_EQ(model.materials[0].name, "diffuse");
  EXPECT_EQ(model.materials[1].name, "silver");
  EXPECT_EQ(model.materials[2].name, "mirror");
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    EXPECT_LT(model.meshes[i].vertices.col(0).maxCoeff(), model.meshes[i + 1].vertices.col(0).minCoeff());
  }
}

TEST(Shapes, UnknownNameIsRefused) {
  using faceprobe::testing::expect_error;
  expect_error(ExitCode::kUsage, {"'dodecahedron'", "sphere, cube, pot, robot, spheres"}, [] { shape("dodecahedron"); });
  expect_error(ExitCode::kUsage, {"''"}, [] { shape(""); });
}

}  // namespace
}  // namespace faceprobe::render
