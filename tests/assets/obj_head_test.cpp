#include "faceprobe/assets/heads.h"
#include "faceprobe/io/picture_file.h"
#include "file_fixtures.h"

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::TempFolder;
using testing::write_text;

// A block 0.2 wide, 0.3 high, with a tip in front.
std::string pyramid(float scale, const std::string& head = "") {
  std::string text = head;
  const auto vertex = [&](float x, float y, float z) {
    text += "v " + std::to_string(x * scale) + " " + std::to_string(y * scale) + " " + std::to_string(z * scale) + "\n";
  };
  vertex(-0.1F, 1.0F, 0);
  vertex(0.1F, 1.0F, 0);
  vertex(0.1F, 1.3F, 0);
  vertex(-0.1F, 1.3F, 0);
  vertex(0.01F, 1.15F, 0.1F);
  return text;
}
constexpr const char* kFaces = "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 4 3 2 1\n";
constexpr const char* kTextured = "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 5/3\nf 2/2 3/3 5/1\n";

TEST(ObjHead, ReadsVerticesAndCutsQuads) {
  const TempFolder folder;
  write_text(folder / "a.obj", pyramid(1) + kFaces);
  const synth::HeadModel model = load_obj_head(folder / "a.obj");
  EXPECT_EQ(model.name, "a");
  EXPECT_EQ(model.validate(), "");
  EXPECT_EQ(model.neutral.rows(), 5);
  ASSERT_EQ(model.triangles.rows(), 6);
  EXPECT_EQ(model.triangles.row(4), Eigen::RowVector3i(3, 2, 1));
  EXPECT_EQ(model.triangles.row(5), Eigen::RowVector3i(3, 1, 0));
  EXPECT_EQ(model.uv_layout, synth::UvLayout::kNone);
  // The tip is taken for the nose's: the eyes' middle is 43 mm above and 35 mm behind it. Six printed digits.
  EXPECT_LE((model.neutral.row(4) - Eigen::RowVector3f(0, -0.043F, 0.035F)).norm(), 2e-6F);
}

TEST(ObjHead, GuessesUnitsFromTheHeightAndTakesThemGiven) {
  const TempFolder folder;
  const auto height = [&](float scale, float units_m) {
    write_text(folder / "a.obj", pyramid(scale) + kFaces);
    const synth::HeadModel model = load_obj_head(folder / "a.obj", {.units_m = units_m});
    return model.neutral.col(1).maxCoeff() - model.neutral.col(1).minCoeff();
  };
  EXPECT_NEAR(height(1, 0), 0.3F, 1e-5F);     // metres
  EXPECT_NEAR(height(100, 0), 0.3F, 1e-5F);   // centimetres
  EXPECT_NEAR(height(1000, 0), 0.3F, 1e-5F);  // millimetres
  EXPECT_NEAR(height(1, 0.5F), 0.15F, 1e-5F);
  expect_error(ExitCode::kUsage, {"-1", "above 0"}, [&] { height(1, -1); });
}

TEST(ObjHead, TakesLandmarksFromTheFileBeside) {
  const TempFolder folder;
  write_text(folder / "a.obj", pyramid(1) + kFaces);
  std::string list;
  for (int i = 0; i < 68; ++i) list += i >= 36 && i < 48 ? "4\n" : "0, ";
  write_text(folder / "a.landmarks.txt", list);
  const synth::HeadModel model = load_obj_head(folder / "a.obj");
  ASSERT_EQ(model.landmarks.size(), 68U);
  EXPECT_LE(model.neutral.row(4).norm(), 1e-6F);  // the twelve eye landmarks lie there: float rounding of their mean

  write_text(folder / "a.landmarks.txt", "1 2 3");
  expect_error(ExitCode::kInput, {"a.landmarks.txt", "holds 3", "68"}, [&] { load_obj_head(folder / "a.obj"); });
  write_text(folder / "a.landmarks.txt", "1 2 5");
  expect_error(ExitCode::kInput, {"from 0 to 4", "first 2"}, [&] { load_obj_head(folder / "a.obj"); });
  write_text(folder / "a.landmarks.txt", "1 nose");
  expect_error(ExitCode::kInput, {"from 0 to 4"}, [&] { load_obj_head(folder / "a.obj"); });
}

TEST(ObjHead, TakesTheTextureOfItsMaterialOrTheOneBeside) {
  const TempFolder folder;
  ByteImage red(4, 2, 3);
  for (int i = 0; i < 8; ++i) red.data()[3 * i] = 200;
  io::write_picture(folder / "skin.png", red);
  write_text(folder / "head.mtl", "newmtl skin\nmap_Kd skin.png\n");
  write_text(folder / "a.obj", pyramid(1, "mtllib head.mtl\nusemtl skin\n") + kTextured);
  const synth::HeadModel model = load_obj_head(folder / "a.obj");
  EXPECT_EQ(model.texture, red);  // bytes of sRGB to light and back
  EXPECT_EQ(model.uv_layout, synth::UvLayout::kOwn);
  EXPECT_EQ(model.triangle_uv.row(1), Eigen::RowVector3i(1, 2, 0));

  write_text(folder / "b.obj", pyramid(1) + kTextured);
  EXPECT_TRUE(load_obj_head(folder / "b.obj").texture.empty());
  std::filesystem::copy_file(folder / "skin.png", folder / "b.png");
  EXPECT_EQ(load_obj_head(folder / "b.obj").texture, red);

  std::filesystem::remove(folder / "skin.png");
  expect_error(ExitCode::kInput, {"a.obj", "skin.png", "not there"}, [&] { load_obj_head(folder / "a.obj"); });
}

TEST(ObjHead, RefusesBrokenFiles) {
  const TempFolder folder;
  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    write_text(folder / "bad.obj", text);
    expect_error(ExitCode::kInput, words, [&] { load_obj_head(folder / "bad.obj"); });
  };
  refused(pyramid(1) + "f 1 2 9\n", {"bad.obj", "vertex 9", "there are 5"});
  refused(pyramid(1) + "f 1 2 0\n", {"bad.obj"});
  refused(pyramid(1) + "f -9 1 2\n", {"bad.obj"});
  refused(pyramid(1) + "v nan 0 0\n" + kFaces, {"'nan' in line 6", "finite"});
  refused(pyramid(1) + "v 0 inf 0\n" + kFaces, {"'inf' in line 6"});
  refused(pyramid(1) + "v 0 0\n" + kFaces, {"'' in line 6"});
  refused(pyramid(1) + "v 0 0 1e30\n" + kFaces, {"'1e30' in line 6"});
  refused(pyramid(1) + "v 0 0 x\n" + kFaces, {"'x' in line 6"});
  refused(pyramid(1), {"no faces", "5 vertices"});
  refused("hello\n", {"no vertices"});
  refused("", {"no vertices"});
  refused(pyramid(1) + "vt 0 nan\n" + kFaces, {"'nan' in line 6"});
  refused(pyramid(1) + "vt 0 0\nf 1/1 2/1 3/7\n", {"texture point 7", "there are 1"});
  expect_error(ExitCode::kInput, {"none.obj"}, [&] { load_obj_head(folder / "none.obj"); });
}

TEST(LoadHeads, FindsFilesByNameInAFolderAndBelowIt) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"no head model", "ICT-FaceKit"}, [&] { load_heads(folder.path()); });
  std::filesystem::create_directory(folder / "below");
  write_text(folder / "below/c.obj", pyramid(1) + kFaces);
  ASSERT_EQ(load_heads(folder.path()).size(), 1U);
  write_text(folder / "b.obj", pyramid(1) + kFaces);
  write_text(folder / "a.obj", pyramid(1) + kFaces);
  const std::vector<synth::HeadModel> heads = load_heads(folder.path());
  ASSERT_EQ(heads.size(), 2U);
  EXPECT_EQ(heads[0].name, "a");
  EXPECT_EQ(heads[1].name, "b");
  EXPECT_EQ(load_heads(folder / "a.obj").size(), 1U);
  expect_error(ExitCode::kInput, {"missing"}, [&] { load_heads(folder / "missing"); });
  write_text(folder / "note.txt", "x");
  expect_error(ExitCode::kInput, {"note.txt", ".mat", ".h5"}, [&] { load_heads(folder / "note.txt"); });
}

}  // namespace
}  // namespace faceprobe::assets
