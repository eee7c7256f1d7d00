#include "faceprobe/core/vertex_normals.h"

#include "faceprobe/core/angles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace faceprobe {
namespace {

constexpr float kRounding = 1e-6F;  // of sums of a few floats about 1

#define EXPECT_NORMAL(row, ...) EXPECT_NEAR(((row)-Eigen::RowVector3f(__VA_ARGS__)).norm(), 0, kRounding)

struct Mesh {
  Eigen::MatrixX3f vertices;
  Eigen::MatrixX3i triangles;
};

// Of radius 1: poles along y, columns of vertices between them; its triangles' areas differ several times.
Mesh sphere(int rings, int columns) {
  Mesh mesh{Eigen::MatrixX3f((rings - 1) * columns + 2, 3), Eigen::MatrixX3i(2 * (rings - 1) * columns, 3)};
  mesh.vertices.row(0) << 0, 1, 0;
  mesh.vertices.bottomRows<1>() << 0, -1, 0;
  const auto vertex = [&](int ring, int column) {
    if (ring == 0) return 0;
    if (ring == rings) return (rings - 1) * columns + 1;
    return 1 + (ring - 1) * columns + column % columns;
  };
  Eigen::Index t = 0;
  for (int r = 0; r < rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const double polar = kPi * r / rings;
      const double azimuth = 2 * kPi * c / columns;
      mesh.vertices.row(vertex(r, c)) =
          Eigen::RowVector3d(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth))
              .cast<float>();
      if (r > 0) mesh.triangles.row(t++) << vertex(r, c), vertex(r + 1, c), vertex(r, c + 1);
      if (r + 1 < rings) mesh.triangles.row(t++) << vertex(r, c + 1), vertex(r + 1, c), vertex(r + 1, c + 1);
    }
  }
  return mesh;
}

TEST(VertexNormals, OfASphereAreItsRadii) {
  const auto worst = [](int rings) {
    const Mesh mesh = sphere(rings, 2 * rings);
    return (vertex_normals(mesh.vertices, mesh.triangles) - mesh.vertices).rowwise().norm().maxCoeff();
  };
  const float coarse = worst(12);
  const float fine = worst(24);
  // A triangle's normal is that of its middle, half a step of pi / 12 = 0.26 off; six around a vertex outweigh each other by half at least.
  EXPECT_LT(coarse, 0.065F);
  // Beside the poles the diagonals lean one way at any fineness, so that the error falls with the step, elsewhere faster.
  EXPECT_LT(fine, 0.55F * coarse);
}

TEST(VertexNormals, ACubesCornerLooksAlongItsDiagonal) {
  // Corner i has the bits of i as coordinates. The diagonals meet in corners 0, 3, 5 and 6: two triangles of each face there, one elsewhere,
  // so that every corner has as much area of each face.
  Mesh cube{Eigen::MatrixX3f(8, 3), Eigen::MatrixX3i(12, 3)};
  for (int i = 0; i < 8; ++i)
    cube.vertices.row(i) << static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2);
  cube.triangles << 0, 3, 1, 0, 2, 3,  // z = 0
      4, 5, 6, 5, 7, 6,                // z = 1
      0, 1, 5, 0, 5, 4,                // y = 0
      2, 6, 3, 3, 6, 7,                // y = 1
      0, 6, 2, 0, 4, 6,                // x = 0
      1, 3, 5, 3, 7, 5;                // x = 1
  const Eigen::MatrixX3f normals = vertex_normals(cube.vertices, cube.triangles);
  for (int i = 0; i < 8; ++i)
    EXPECT_NORMAL(normals.row(i), (2 * cube.vertices.row(i).array() - 1).matrix().normalized()) << i;
}

// A triangle of area 2 towards +z and one of area 1 towards +x share the edge 0-1; vertex 4 is in none.
Mesh folded() {
  Mesh mesh{Eigen::MatrixX3f(5, 3), Eigen::MatrixX3i(2, 3)};
  mesh.vertices << 0, 0, 0, 0, 2, 0, -2, 0, 0, 0, 0, -1, 9, 9, 9;
  mesh.triangles << 0, 1, 2, 0, 3, 1;
  return mesh;
}

TEST(VertexNormals, WeighByArea) {
  const Mesh mesh = folded();
  const Eigen::MatrixX3f normals = vertex_normals(mesh.vertices, mesh.triangles);
  EXPECT_NORMAL(normals.row(2), 0, 0, 1);
  EXPECT_NORMAL(normals.row(3), 1, 0, 0);
  EXPECT_NORMAL(normals.row(0), 1 / std::sqrt(5.0F), 0, 2 / std::sqrt(5.0F));
  EXPECT_NORMAL(normals.row(4), 0, 0, 1);
}

TEST(VertexNormals, SumsAreTwiceTheAreas) {
  const Mesh mesh = folded();
  const Eigen::MatrixX3f sums = area_normals(mesh.vertices, mesh.triangles);
  EXPECT_NORMAL(sums.row(0), 2, 0, 4);
  EXPECT_NORMAL(sums.row(4), 0, 0, 0);
}

TEST(VertexNormals, OfTinyTrianglesHaveUnitLengthInDouble) {
  Mesh mesh = folded();
  mesh.vertices *= 1e-15F;  // whose areas, squared, are no float
  EXPECT_NORMAL(vertex_normals<double>(mesh.vertices, mesh.triangles).row(3), 1, 0, 0);
}

}  // namespace
}  // namespace faceprobe
