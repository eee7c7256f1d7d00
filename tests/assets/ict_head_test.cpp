#include "faceprobe/assets/heads.h"
#include "file_fixtures.h"

#include <cmath>

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::npy_text;
using testing::TempFolder;

// A stand-in of ICT-FaceKit's size: as many vertices, a handful of faces. Vertex v lies at a place of its own, in centimetres.
constexpr int kVertices = 26719;
constexpr int kHeadVertices = 11248;
Eigen::RowVector3f place(int v) {
  return {8 * std::sin(static_cast<float>(v)), 10 * std::sin(1.7F * static_cast<float>(v)),
          5 * std::cos(0.6F * static_cast<float>(v))};
}
// Some landmarks of the right and left eye (Multi-PIE 36, 42), as in the model's own list.
constexpr int kRightEyeLandmark = 1507, kLeftEyeLandmark = 3742;

struct Face {
  int region;
  std::vector<int> corners;
};
const std::vector<Face> kFaces = {
    {0, {10, 11, 12, 13}},       {1, {9500, 9501, 9502}},    {2, {11300, 11301, 11302, 11303}},
    {3, {13300, 13301, 13302}},  {5, {14100, 14101, 14102}}, {6, {17100, 17101, 17102}},
    {7, {21500, 21501, 21502}},  {8, {24588, 24589, 24590}}, {9, {24600, 24601, 24602}},
    {13, {25100, 25101, 25102}}, {16, {26700, 26717, 26718}}};

std::string points_text(int count) {
  std::vector<float> values;
  for (int v = 0; v < count; ++v) {
    for (const float x : place(v)) values.push_back(x);
  }
  return npy_text("<f4", {static_cast<std::size_t>(count), 3}, values);
}

std::map<std::string, std::string> topology() {
  std::vector<std::int32_t> faces;
  std::vector<std::int32_t> faces_uv;
  std::vector<std::uint8_t> regions;
  for (const Face& face : kFaces) {
    for (std::size_t i = 0; i < 4; ++i) {
      faces.push_back(i < face.corners.size() ? face.corners[i] : -1);
      faces_uv.push_back(i < face.corners.size() ? static_cast<std::int32_t>(i) : -1);
    }
    regions.push_back(static_cast<std::uint8_t>(face.region));
  }
  return {{"neutral", points_text(kVertices)},
          {"faces", npy_text("<i4", {kFaces.size(), 4}, faces)},
          {"faces_uv", npy_text("<i4", {kFaces.size(), 4}, faces_uv)},
          {"uv", npy_text<float>("<f4", {4, 2}, {0, 0, 1, 0, 1, 1, 2.5F, 1})},
          {"face_region", npy_text("|u1", {kFaces.size()}, regions)}};
}

// Modes in halves: 1 moves everything by 0.5 cm along x; 2 only the vertex named.
std::string modes_text(int vertices, int modes, int vertex = 0) {
  constexpr std::uint16_t kHalf = 0x3800;  // 0.5
  std::vector<std::uint16_t> values(static_cast<std::size_t>(modes * vertices) * 3, 0);
  for (int m = 0; m < modes; ++m) {
    for (int v = 0; v < vertices; ++v) {
      if (m == 0 || v == vertex) values[static_cast<std::size_t>(m * vertices + v) * 3] = kHalf;
    }
  }
  return npy_text("<f2", {static_cast<std::size_t>(modes), static_cast<std::size_t>(vertices), 3}, values);
}

void write_folder(const TempFolder& folder) {
  testing::write_npz(folder / "ict_topology.npz", topology());
  testing::write_npz(folder / "morphs_full_f16.npz",
                     {{"identity", modes_text(kVertices, 2, 11)}, {"expression", modes_text(kVertices, 1)}});
  testing::write_text(folder / "ict_meta.json", R"({"expression_names": ["jawOpen"]})");
}

TEST(IctHead, KeepsSkinEyesMouthAndTeethInMetres) {
  const TempFolder folder;
  write_folder(folder);
  const synth::HeadModel model = load_ict_head(folder.path());
  EXPECT_EQ(model.validate(), "");
  EXPECT_EQ(model.uv_layout, synth::UvLayout::kIctFace);
  EXPECT_EQ(model.neutral.rows(), 24591);  // shells and lashes left out
  ASSERT_EQ(model.triangles.rows(), 10);   // eight faces, two of them quads
  EXPECT_EQ(model.triangles.row(0), Eigen::RowVector3i(10, 11, 12));
  EXPECT_EQ(model.triangles.row(1), Eigen::RowVector3i(10, 12, 13));
  using synth::Material;
  EXPECT_EQ(
      model.triangle_material,
      (std::vector<Material>{Material::kSkin, Material::kSkin, Material::kSkin, Material::kMouth, Material::kMouth,
                             Material::kSkin, Material::kMouth, Material::kTeeth, Material::kEye, Material::kEye}));
  EXPECT_EQ(model.triangle_uv.row(1), Eigen::RowVector3i(0, 2, 3));
  EXPECT_EQ(model.uv(3, 0), 2.5F);
  // Differences are the file's, in metres; 2e-7 is float rounding of numbers up to .1.
  EXPECT_LE((model.neutral.row(12) - model.neutral.row(10) - (place(12) - place(10)) * 0.01F).norm(), 2e-7F);
  ASSERT_EQ(model.landmarks.size(), 68U);
  Eigen::RowVector3f eyes = Eigen::RowVector3f::Zero();
  for (std::size_t i = 36; i < 48; ++i) eyes += model.neutral.row(model.landmarks[i]);
  EXPECT_LE(eyes.norm() / 12, 1e-7F);
  EXPECT_EQ(model.vertex_region[21500], Region::kEyes);
  EXPECT_EQ(model.vertex_region[17100], Region::kMouth);
  ASSERT_EQ(model.identity.size(), 2U);
  EXPECT_FLOAT_EQ(model.identity[0](24590, 0), 0.005F);
  EXPECT_FLOAT_EQ(model.identity[1].norm(), 0.005F);
  EXPECT_EQ(model.expression_names, std::vector<std::string>{"jawOpen"});
}

TEST(IctHead, PartsBehindTheSkinFollowModesOfTheSkinAlone) {
  const TempFolder folder;
  write_folder(folder);
  std::filesystem::remove(folder / "morphs_full_f16.npz");
  testing::write_text(folder / "identity_head_f16.npy", modes_text(kHeadVertices, 2, kRightEyeLandmark));
  testing::write_text(folder / "expression_head_f16.npy", modes_text(kHeadVertices, 1));
  const synth::HeadModel model = load_ict_head(folder.path());
  EXPECT_EQ(model.validate(), "");
  EXPECT_FLOAT_EQ(model.identity[0](21500, 0), 0.005F);      // all landmarks move, so all the rest does
  EXPECT_FLOAT_EQ(model.identity[1](24588, 0), 0.005F / 6);  // one of the right eye's six
  EXPECT_EQ(model.identity[1](21500, 0), 0);                 // the left eye stays
  EXPECT_EQ(model.identity[1](17100, 0), 0);
  EXPECT_EQ(model.expression[0].rows(), kHeadVertices);
}

TEST(IctHead, RefusesWhatDoesNotFit) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"no ICT-FaceKit folder", "generic_neutral_mesh.obj"},
               [&] { load_ict_head(folder.path()); });
  write_folder(folder);
  const auto refused = [&](const std::vector<std::string>& words) {
    expect_error(ExitCode::kInput, words, [&] { load_ict_head(folder.path()); });
  };
  testing::write_text(folder / "ict_meta.json", R"({"expression_names": ["a", "b"]})");
  refused({"ict_meta.json", "names 2", "hold 1"});
  testing::write_text(folder / "ict_meta.json", "{");
  refused({"ict_meta.json"});
  testing::write_npz(folder / "morphs_full_f16.npz",
                     {{"identity", modes_text(100, 1)}, {"expression", modes_text(kVertices, 1)}});
  refused({"'identity' is 1 x 100 x 3", "26719"});
  testing::write_npz(folder / "morphs_full_f16.npz", {{"identity", modes_text(kVertices, 1)}});
  refused({"morphs_full_f16.npz", "'expression'"});
  auto arrays = topology();
  arrays.erase("faces_uv");
  testing::write_npz(folder / "ict_topology.npz", arrays);
  refused({"ict_topology.npz", "'faces_uv'"});
  arrays = topology();
  arrays["neutral"] = points_text(50);
  testing::write_npz(folder / "ict_topology.npz", arrays);
  refused({"50 vertices", "26719"});
}

TEST(IctHead, RefusesFacesOutOfRange) {
  const TempFolder folder;
  write_folder(folder);
  auto arrays = topology();
  std::vector<std::int32_t> faces(kFaces.size() * 4, 40000);
  arrays["faces"] = npy_text("<i4", {kFaces.size(), 4}, faces);
  testing::write_npz(folder / "ict_topology.npz", arrays);
  expect_error(ExitCode::kInput, {"faces that name vertices"}, [&] { load_ict_head(folder.path()); });
}

// The same model as OBJ files: every face of the file's count, those of the list at the right numbers.
std::string obj_text(float shift, bool faces) {
  std::string text;
  char line[96];
  for (int v = 0; v < kVertices; ++v) {
    const Eigen::RowVector3f p = place(v);
    std::snprintf(line, sizeof line, "v %.6f %.6f %.6f\n", static_cast<double>(p.x() + shift),
                  static_cast<double>(p.y()), static_cast<double>(p.z()));
    text += line;
  }
  if (!faces) return text;
  text += "vt 0 0\nvt 1 0\nvt 1 1\n";
  constexpr std::pair<int, int> kFirst[] = {
      {0, 11}, {21496, 21501}, {23093, 21501}, {23094, 24001}, {26383, 26701}};  // face, its first vertex
  std::size_t next = 0;
  for (int face = 0; face < 26384; ++face) {
    if (next < std::size(kFirst) && kFirst[next].first == face) {
      const int first = kFirst[next++].second;
      std::snprintf(line, sizeof line, "f %d/1 %d/2 %d/3\n", first, first + 1, first + 2);
      text += line;
    } else {
      text += "f 1/1 2/2 3/3\n";
    }
  }
  return text;
}

TEST(IctHead, LoadsTheOriginalObjFiles) {
  const TempFolder folder;
  testing::write_text(folder / "generic_neutral_mesh.obj", obj_text(0, true));
  testing::write_text(folder / "identity000.obj", obj_text(0.5F, false));
  testing::write_text(folder / "jawOpen.obj", obj_text(0.25F, false));
  const synth::HeadModel model = load_ict_head(folder.path());
  EXPECT_EQ(model.validate(), "");
  ASSERT_EQ(model.identity.size(), 1U);
  EXPECT_NEAR(model.identity[0](77, 0), 0.005F, 3e-8F);  // six decimals of a centimetre, twice
  EXPECT_EQ(model.expression_names, std::vector<std::string>{"jawOpen"});
  ASSERT_EQ(model.triangles.rows(), 24692);  // regions 0 to 8
  EXPECT_EQ(model.triangles.row(0), Eigen::RowVector3i(10, 11, 12));
  EXPECT_EQ(model.triangle_material[21495], synth::Material::kTeeth);
  EXPECT_EQ(model.triangle_material[21496], synth::Material::kEye);
  EXPECT_EQ(model.triangle_material[24691], synth::Material::kEye);
  EXPECT_EQ(model.triangle_material[11143], synth::Material::kSkin);
  EXPECT_EQ(model.triangle_material[11144], synth::Material::kMouth);

  testing::write_text(folder / "identity001.obj", "v 0 0 0\n");
  expect_error(ExitCode::kInput, {"identity001.obj", "1 vertices", "26719"}, [&] { load_ict_head(folder.path()); });
  std::filesystem::remove(folder / "identity001.obj");
  testing::write_text(folder / "generic_neutral_mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  expect_error(ExitCode::kInput, {"3 vertices and 1 faces", "26719", "26384"}, [&] { load_ict_head(folder.path()); });
}

}  // namespace
}  // namespace faceprobe::assets
