#include "faceprobe/eval/case_folder.h"

#include "eval/case_fixtures.h"
#include "eval/case_pose.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/lighting/main_lights.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <limits>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;
using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;
using fixtures::hdr_with_lamp;
using fixtures::plain;
using fixtures::whole_case;
using fixtures::write_bytes;
using fixtures::write_exr_with;

constexpr float kHalf = 1.0F / 1024;  // of a value: half floats have ten bits behind the point
constexpr float kRgbe = 1.0F / 128;   // of a texel's largest channel: eight bits

void expect_near(const Image& a, const Image& b, float relative) {
  ASSERT_TRUE(a.same_size(b));
  ASSERT_EQ(a.channels(), b.channels());
  for (std::size_t i = 0; i < a.values().size(); ++i)
    ASSERT_NEAR(a.data()[i], b.data()[i], relative * std::abs(b.data()[i]) + 1e-7F) << "value " << i;
}

TEST(CaseFolder, ComesBackAsItWasWritten) {
  const TempFolder folder;
  const Case wrote = whole_case();
  write_case(folder / "one", wrote);
  const Case read = read_case(folder / "one");
  EXPECT_EQ(read.name, "one");
  EXPECT_EQ(read.photo, wrote.photo);
  EXPECT_EQ(read.mask, wrote.mask);
  expect_near(read.highlight, wrote.highlight, kHalf);
  expect_near(read.diffuse, wrote.diffuse, kHalf);
  expect_near(read.normal_cam, wrote.normal_cam, kHalf);  // the sign is kept
  ASSERT_TRUE(read.light);
  expect_near(read.light->radiance(), wrote.light->radiance(), kRgbe);
  ASSERT_TRUE(read.pose);
  EXPECT_EQ(read.pose->camera.focal_px, 800.5);
  EXPECT_EQ(read.pose->camera.centre_y_px, 6);
  EXPECT_EQ(read.pose->camera_from_head.matrix(), wrote.pose->camera_from_head.matrix());  // shortest digits are exact
  EXPECT_EQ(read.groups, wrote.groups);
  EXPECT_EQ(read.licence, "CC0-1.0");
  EXPECT_EQ(read_case((folder / "one").string() + "/").name, "one");
}

TEST(CaseFolder, EveryCodeOfAPhotoComesBack) {
  const TempFolder folder;
  Case one = whole_case();
  one.photo = ByteImage(16, 16, 3);
  for (std::size_t i = 0; i < 256; ++i) std::fill_n(one.photo.data() + 3 * i, 3, static_cast<std::uint8_t>(i));
  one.highlight = one.diffuse = one.normal_cam = Image();
  one.mask = ByteImage();
  write_case(folder / "one", one);
  EXPECT_EQ(read_case(folder / "one").photo, one.photo);
}

TEST(CaseFolder, PhotoAndOneTruthAreEnough) {
  const TempFolder folder;
  Case one;
  one.photo = ByteImage(4, 3, 3, 9);
  one.highlight = Image(4, 3, 3, 0.25F);
  write_case(folder / "layers", one);
  const Case layers = read_case(folder / "layers");
  EXPECT_FALSE(layers.light);
  EXPECT_FALSE(layers.pose);
  EXPECT_TRUE(layers.mask.empty());
  EXPECT_TRUE(layers.groups.empty());
  EXPECT_FALSE(fs::exists(folder / "layers/case.json"));
  one.highlight = Image();
  one.light = whole_case().light;
  write_case(folder / "light", one);
  EXPECT_TRUE(read_case(folder / "light").highlight.empty());
  one.light.reset();
  EXPECT_THROW(write_case(folder / "nothing", one), std::invalid_argument);
  EXPECT_FALSE(fs::exists(folder / "nothing"));
}

// A quarter of the width is +x, the right of the photo, and row 0 is up, whichever program wrote the file.
TEST(CaseFolder, ALampAtTheRightOfTheMapIsAtPlusX) {
  const TempFolder folder;
  Case one;
  one.photo = ByteImage(4, 3, 3, 9);
  one.highlight = Image(4, 3, 3, 0.25F);
  write_case(folder / "one", one);
  const SphereGrid grid(16);
  const auto lamp = [&](int x, int y) {
    write_bytes(folder / "one/gt.hdr", hdr_with_lamp(64, 32, x, y));
    const auto lights = lighting::main_lights(grid_from_env_map(*read_case(folder / "one").light, grid), grid);
    return lights.empty() ? Eigen::Vector3d(0, 0, 0) : lights[0].direction;
  };
  // A texel of 64 is 5.6 degrees wide, and its centre half of that beside the axis: cos 6 degrees.
  EXPECT_GT(lamp(16, 16).x(), 0.994);
  EXPECT_GT(lamp(32, 16).z(), 0.994);
  EXPECT_LT(lamp(48, 16).x(), -0.994);
  EXPECT_GT(lamp(32, 1).y(), 0.98);
}

struct Broken {
  std::string file;  // that is written ...
  std::function<void(const fs::path&)> write;
  std::vector<std::string> says;  // ... and what the sentence says beside its name
};

TEST(CaseFolder, NamesEachFileThatIsNotInOrder) {
  const float nan = std::nanf("");
  const auto text = [](const std::string& bytes) { return [bytes](const fs::path& path) { write_bytes(path, bytes); }; };
  const auto exr = [](int width, int height, float fill, float odd) {
    return [=](const fs::path& path) { write_exr_with(path, width, height, fill, odd); };
  };
  const auto picture = [](const auto& image) {
    return [image](const fs::path& path) { io::write_picture(path, image); };
  };
  ByteImage soft(16, 12, 1, 255);
  soft(5, 5) = 128;
  const std::string rows = "1 0 0 0\n0 1 0 0\n0 0 1 -1\n";
  const std::vector<Broken> all = {
      {"photo.png", text("not a picture"), {"JPEG, PNG"}},
      {"photo.png", text(""), {"empty"}},
      {"highlight.exr", text("not a picture"), {}},
      {"highlight.exr", picture(Image(8, 12, 3, 0.5F)), {"8 x 12", "16 x 12", "one size"}},
      {"highlight.exr", exr(16, 12, 0.5F, nan), {"not finite", "column 5, row 2"}},
      {"highlight.exr", exr(16, 12, 0.5F, std::numeric_limits<float>::infinity()), {"not finite"}},
      {"highlight.exr", exr(16, 12, 0.5F, -0.25F), {"below 0", "column 5, row 2"}},
      {"diffuse.exr", picture(Image(16, 11, 3, 0.5F)), {"16 x 11"}},
      {"diffuse.exr", exr(16, 12, 0.5F, -0.25F), {"below 0"}},
      {"normal.exr", picture(Image(16, 13, 3)), {"16 x 13"}},
      {"normal.exr", exr(16, 12, 0.0F, 0.5F), {"length 0.5", "column 5, row 2"}},
      {"normal.exr", exr(16, 12, 0.0F, nan), {"not finite"}},
      {"mask.png", picture(ByteImage(16, 13, 1, 255)), {"16 x 13"}},
      {"mask.png", picture(soft), {"the value 128", "255"}},
      {"mask.png", picture(ByteImage(16, 12, 1)), {"0 everywhere"}},
      {"gt.hdr", text("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n"), {}},
      {"gt.hdr", text(hdr_with_lamp(9, 4, 1, 1)), {"9 x 4", "twice as wide"}},
      {"gt.hdr", picture(Image(8, 4, 3)), {"black"}},
      {"gt.exr", picture(Image(8, 4, 3, 1.0F)), {"both gt.hdr and gt.exr"}},
      {"pose.txt", text("800\n8 6\n" + rows + "1\n"), {"line 6"}},
      {"pose.txt", text("800\n8 6\n1 0 0 0\n"), {"3 line(s)"}},
      {"pose.txt", text("800\n8\n" + rows), {"1 number(s) in line 2"}},
      {"pose.txt", text("wide\n8 6\n" + rows), {"'wide'"}},
      {"pose.txt", text("nan\n8 6\n" + rows), {"'nan'"}},
      {"pose.txt", text("0\n8 6\n" + rows), {"focal length of 0"}},
      {"pose.txt", text("800\n8 6\n2 0 0 0\n0 1 0 0\n0 0 1 -1\n"), {"no rotation"}},
      {"pose.txt", text("800\n8 6\n-1 0 0 0\n0 1 0 0\n0 0 1 -1\n"), {"no rotation", "mirrored"}},
      {"pose.txt", text("800\n8 6\n1 0 0 0\n0 1 0 0\n0 0 1 1\n"), {"z = 1"}},
      {"pose.txt", text(std::string(70'000, '\n')), {"70000 bytes"}},
      {"case.json", text("{\"groups\""), {"no JSON object"}},
      {"case.json", text("[1]"), {"no JSON object"}},
      {"case.json", text("{\"groups\": [1]}"), {"groups"}},
      {"case.json", text("{\"groups\": {\"scene\": 3}}"), {"'scene'", "no text"}},
      {"case.json", text("{\"groups\": {\"Sc|ene\": \"a\"}}"), {"'Sc|ene'"}},
      {"case.json", text("{\"groups\": {\"method\": \"a\"}}"), {"'method'"}},
      {"case.json", text("{\"groups\": {\"scene\": \"\"}}"), {"scene", "1 to 80"}},
      {"case.json", text("{\"groups\": {\"scene\": \"a\\nb\"}}"), {"scene", "lines"}},
      {"case.json", text("{\"licence\": 0}"), {"licence"}},
  };
  for (const Broken& broken : all) {
    SCOPED_TRACE(broken.file + ": " + (broken.says.empty() ? "" : broken.says[0]));
    const TempFolder folder;
    write_case(folder / "one", whole_case());
    broken.write(folder / "one" / broken.file);
    std::vector<std::string> says = broken.says;
    says.push_back((folder / "one").string());
    // Of two files of the truth none is the wrong one; of a map's values the sentence says "gt".
    says.push_back(broken.file.substr(0, broken.file.find('.')));
    expect_error(ExitCode::kInput, says, [&] { read_case(folder / "one"); });
  }
}

TEST(CaseFolder, NamesWhatIsMissing) {
  const TempFolder folder;
  write_case(folder / "one", whole_case());
  for (const char* file : {"diffuse.exr", "normal.exr", "mask.png", "pose.txt", "case.json", "gt.hdr"})
    fs::remove(folder / "one" / file);
  EXPECT_NO_THROW(read_case(folder / "one"));
  fs::remove(folder / "one/highlight.exr");
  expect_error(ExitCode::kInput, {"gt.hdr, gt.exr and highlight.exr are all missing"},
               [&] { read_case(folder / "one"); });
  fs::remove(folder / "one/photo.png");
  expect_error(ExitCode::kInput, {"one/photo.png is missing"}, [&] { read_case(folder / "one"); });
  expect_error(ExitCode::kInput, {"nowhere", "no folder"}, [&] { read_case(folder / "nowhere"); });
}

TEST(CaseFolder, HoldsFilesToTheLimits) {
  const TempFolder folder;
  write_case(folder / "one", whole_case());
  EXPECT_NO_THROW(read_case(folder / "one", {.max_pixels = 512}));  // of the map
  expect_error(ExitCode::kInput, {"gt.hdr"}, [&] { read_case(folder / "one", {.max_pixels = 511}); });
  expect_error(ExitCode::kInput, {"photo.png"}, [&] { read_case(folder / "one", {.max_pixels = 191}); });
  expect_error(ExitCode::kInput, {"photo.png"}, [&] { read_case(folder / "one", {.max_file_bytes = 20}); });
}

TEST(CaseFolder, APhotoIsAPngOfEightBitsUnderItsName) {
  const TempFolder folder;
  write_case(folder / "one", whole_case());
  fs::copy_file(folder / "one/diffuse.exr", folder / "one/photo.png", fs::copy_options::overwrite_existing);
  expect_error(ExitCode::kInput, {"photo.png is exr"}, [&] { read_case(folder / "one"); });
  const auto png = [&](const OIIO::TypeDesc& type, const char* colours) {
    OIIO::ImageSpec spec(16, 12, 3, type);
    spec.attribute("oiio:ColorSpace", colours);
    const std::vector<float> grey(16 * 12 * 3, 0.5F);
    auto file = OIIO::ImageOutput::create("photo.png");
    ASSERT_TRUE(file && file->open((folder / "one/photo.png").string(), spec));
    ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, grey.data()) && file->close());
  };
  png(OIIO::TypeDesc::UINT8, "sRGB");
  EXPECT_NO_THROW(read_case(folder / "one"));
  png(OIIO::TypeDesc::UINT16, "sRGB");
  expect_error(ExitCode::kInput, {"photo.png is png of 16 bits"}, [&] { read_case(folder / "one"); });
  png(OIIO::TypeDesc::UINT8, "linear");
  expect_error(ExitCode::kInput, {"photo.png has the colour space 'linear'"}, [&] { read_case(folder / "one"); });
  write_case(folder / "two", whole_case());
  fs::copy_file(folder / "two/mask.png", folder / "two/highlight.exr", fs::copy_options::overwrite_existing);
  expect_error(ExitCode::kInput, {"highlight.exr is a png file"}, [&] { read_case(folder / "two"); });
}

TEST(CaseFolder, PosesAreReadWithCommentsAndSigns) {
  const CasePose pose =
      pose_from_text("# all\r\n\r\n  8e2   # focal length\n+8 -6.5\n1 0 0 +0.5\n\n0 1 0 0\n0 0 1 -1.25", "pose.txt");
  EXPECT_EQ(pose.camera.focal_px, 800);
  EXPECT_EQ(pose.camera.centre_y_px, -6.5);
  EXPECT_EQ(pose.camera_from_head.translation(), Eigen::Vector3d(0.5, 0, -1.25));
  EXPECT_EQ(pose_problem(pose, "pose.txt"), "");
}

TEST(CaseFolder, HashesContentsAndNotPlaces) {
  const TempFolder folder;
  write_case(folder / "one", whole_case());
  fs::copy(folder / "one", folder / "another name");
  const std::string hash = case_hash(folder / "one");
  EXPECT_EQ(hash.size(), 64U);
  EXPECT_EQ(case_hash(folder / "another name"), hash);
  write_bytes(folder / "one/README.txt", "no part of the format");
  EXPECT_EQ(case_hash(folder / "one"), hash);
  fs::remove(folder / "one/diffuse.exr");
  EXPECT_NE(case_hash(folder / "one"), hash);
  write_bytes(folder / "another name/case.json", "{}");
  EXPECT_NE(case_hash(folder / "another name"), hash);
}

TEST(CaseFolder, ListsFoldersByName) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {folder.path().string(), "holds no folder"}, [&] { case_folders(folder.path()); });
  for (const char* name : {"b", "a b", ".git"}) fs::create_directory(folder / name);
  write_bytes(folder / "CARD.md", "text");
  EXPECT_EQ(case_folders(folder.path()), (std::vector<fs::path>{folder / "a b", folder / "b"}));
  expect_error(ExitCode::kInput, {"CARD.md", "no folder"}, [&] { case_folders(folder / "CARD.md"); });
}

TEST(CaseResult, TakesAMapALayerOrBoth) {
  const TempFolder folder;
  expect_error(ExitCode::kInput, {"Neither map.hdr, map.exr nor highlight.exr"},
               [&] { read_case_result(folder.path(), 16, 12); });
  write_exr_with(folder / "map.exr", 16, 8, 0.5F, -3.0F);
  const CaseResult map = read_case_result(folder.path(), 16, 12);
  ASSERT_TRUE(map.light);
  EXPECT_TRUE(map.highlight.empty());
  EXPECT_EQ(map.light->radiance()(5, 2, 1), 0);  // harmonics go below 0
  EXPECT_EQ(map.light->radiance()(5, 2, 0), 0.5F);
  io::write_picture(folder / "highlight.exr", Image(16, 12, 3, 0.25F));
  EXPECT_EQ(read_case_result(folder.path(), 16, 12).highlight(3, 3, 2), 0.25F);
  fs::remove(folder / "map.exr");
  EXPECT_FALSE(read_case_result(folder.path(), 16, 12).light);
}

// Sentences are labels of a table: they name files, not folders.
TEST(CaseResult, SaysWhatIsWrongInFewWords) {
  const auto refuses = [](const std::string& file, const auto& write, const std::string& says) {
    const TempFolder folder;
    write(folder / file);
    try {
      read_case_result(folder.path(), 16, 12);
      ADD_FAILURE() << file << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find(folder.path().string()), std::string::npos) << error.what();
    }
  };
  const auto exr = [](int width, int height, float fill, float odd) {
    return [=](const fs::path& path) { write_exr_with(path, width, height, fill, odd); };
  };
  refuses("highlight.exr", exr(12, 16, 0.5F, 0.5F), "12 x 16");
  refuses("highlight.exr", exr(16, 12, 0.5F, std::nanf("")), "not finite");
  refuses("map.exr", exr(16, 8, 0.5F, std::nanf("")), "not finite");
  refuses("map.exr", exr(16, 8, 0.0F, 0.0F), "black");
  refuses("map.exr", exr(16, 8, -1.0F, 0.0F), "black");
  refuses("map.exr", exr(16, 9, 0.5F, 0.5F), "twice as wide");
  refuses(
      "map.hdr", [](const fs::path& path) { write_bytes(path, "no map"); }, "map.hdr");
  refuses(
      "map.hdr",
      [](const fs::path& path) {
        write_bytes(path, hdr_with_lamp(16, 8, 1, 1));
        write_exr_with(path.parent_path() / "map.exr", 16, 8, 0.5F, 0.5F);
      },
      "both map.hdr and map.exr");
}

}  // namespace
}  // namespace faceprobe::eval
