#include "faceprobe/face/canonical_mesh.h"

#include "face/fixtures.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"

#include <gtest/gtest.h>
#include <map>

namespace faceprobe::face {
namespace {

std::string original() { return file_text(io::data_file("canonical-face-model.obj")); }

void expect_refused(const std::string& text, const std::string& part_of_reason) {
  const TemporaryFile file(text);
  try {
    load_canonical_mesh(file.path());
    FAIL() << "accepted a file that " << part_of_reason;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kModel);
    EXPECT_NE(std::string(error.what()).find(part_of_reason), std::string::npos) << error.what();
  }
}

TEST(CanonicalMesh, IsAnAdultFaceInMetres) {
  const CanonicalMesh& mesh = canonical_mesh();
  const Eigen::RowVector3f size = mesh.vertices_m.colwise().maxCoeff() - mesh.vertices_m.colwise().minCoeff();
  EXPECT_NEAR(size.x(), 0.155F, 0.02F);  // bizygomatic breadths of adults lie between 12 and 16 cm
  EXPECT_NEAR(size.y(), 0.18F, 0.02F);
  EXPECT_GT(mesh.vertices_m(4, 2), mesh.vertices_m(234, 2)) << "the nose points to +z";
  EXPECT_GT(mesh.vertices_m(10, 1), mesh.vertices_m(152, 1)) << "the forehead is above the chin";
  EXPECT_GT(mesh.vertices_m(263, 0), mesh.vertices_m(33, 0)) << "the subject's left eye is at +x";
}

TEST(CanonicalMesh, IsOneSheetSeenFromOutside) {
  // Every inner edge is shared by two triangles that run along it in opposite directions; then all face the same side.
  const CanonicalMesh& mesh = canonical_mesh();
  std::map<std::pair<int, int>, int> directed;
  for (const auto& t : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) ++directed[{t(k), t((k + 1) % 3)}];
  }
  int border = 0;
  for (const auto& [edge, count] : directed) {
    EXPECT_EQ(count, 1);
    border += directed.count({edge.second, edge.first}) == 0 ? 1 : 0;
  }
  EXPECT_EQ(border, 36) << "the face oval is the only border: eyes and mouth are closed over";
  const auto first = mesh.triangles.row(0);
  double facing = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Vector3f a = mesh.vertices_m.row(t(1)) - mesh.vertices_m.row(t(0));
    const Eigen::Vector3f b = mesh.vertices_m.row(t(2)) - mesh.vertices_m.row(t(0));
    facing += static_cast<double>(a.cross(b).z());
  }
  EXPECT_GT(facing, 0) << "counter-clockwise from the front, starting with triangle " << first;
}

TEST(CanonicalMesh, UvFollowsTheFace) {
  const CanonicalMesh& mesh = canonical_mesh();
  EXPECT_GE(mesh.uv.minCoeff(), 0);
  EXPECT_LE(mesh.uv.maxCoeff(), 1);
  EXPECT_GT(mesh.uv(10, 1), mesh.uv(152, 1)) << "v points up";
  EXPECT_GT(mesh.uv(263, 0), mesh.uv(33, 0));
}

TEST(CanonicalMesh, RefusesDamagedFiles) {
  const std::string good = original();
  expect_refused(good.substr(0, good.rfind("f ")), "897 triangles instead of");
  expect_refused(good.substr(0, good.find("vt ") + 4), "needs a number");
  expect_refused("", "0 vertices");
  std::string nan = good;
  nan.replace(nan.find("v ") + 2, 8, "nan     ");
  expect_refused(nan, "'nan'");
  std::string huge = good;
  huge.replace(huge.find("v ") + 2, 8, "1e30    ");
  expect_refused(huge, "'1e30'");
  std::string index = good;
  index.replace(index.find("f ") + 2, 3, "999");
  expect_refused(index, "no valid corner");
  expect_refused(good + "v 0 0 0\n", "469 vertices");
  expect_refused(good + "f 1/1 2/2 3/3\n", "899 triangles");
}

TEST(CanonicalMesh, NamesAMissingFile) { EXPECT_THROW(load_canonical_mesh("no/such/mesh.obj"), Error); }

}  // namespace
}  // namespace faceprobe::face
