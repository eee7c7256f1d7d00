#include "serve/requests.h"

#include "faceprobe/render/shapes.h"

#include <gtest/gtest.h>

#include <string>

namespace faceprobe::serve {
namespace {

// Reading it is refused, in a sentence that has this part.
template <class Read>
void expect_refusal(const Read& read, const std::string& body, const std::string& part) {
  const std::string shown = body.substr(0, 80);
  try {
    read(body);
    ADD_FAILURE() << "not refused: " << shown;
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.failure().kind, FailureKind::kUsage) << shown;
    EXPECT_NE(refusal.failure().sentence.find(part), std::string::npos) << shown << ": " << refusal.failure().sentence;
  }
}

void expect_no_insertion(const std::string& body, const std::string& part) {
  expect_refusal([](const std::string& text) { read_insertion_request(text); }, body, part);
}

void expect_no_sample(const std::string& body, const std::string& part) {
  expect_refusal([](const std::string& text) { read_sample_request(text); }, body, part);
}

TEST(InsertionRequests, AllThatCanBeAskedForIsRead) {
  const InsertionRequest request = read_insertion_request(
      R"({"object": "pot", "material": "gold", "at_px": [12.5, 30], "distance_m": 0.75, "height_m": 0.25,
          "turn_deg": -40, "ground": false, "face": 1, "joint_light": true, "quality": "preview"})");
  EXPECT_EQ(request.object, "pot");
  EXPECT_EQ(request.material, "gold");
  ASSERT_TRUE(request.where.at_px);
  EXPECT_EQ(*request.where.at_px, Eigen::Vector2d(12.5, 30));
  EXPECT_EQ(request.where.depth_m, 0.75F);
  EXPECT_EQ(request.where.height_m, 0.25F);
  EXPECT_EQ(request.where.turn_deg, -40);
  EXPECT_FALSE(request.where.ground);
  EXPECT_EQ(request.where.face, 1);
  EXPECT_TRUE(request.where.joint_light);
  EXPECT_TRUE(request.preview);
}

TEST(InsertionRequests, AMaterialIsChanged) {
  const InsertionRequest request = read_insertion_request(
      R"({"object": "pot", "kind": "plastic", "colour_rgb": [0.5, 0, 0.25], "roughness": 0.5, "index": 1.25, "beside_m": -0.5})");
  EXPECT_EQ(request.surface.kind, render::MaterialKind::kPlastic);
  EXPECT_EQ(request.surface.colour, Eigen::Vector3f(0.5F, 0, 0.25F));
  EXPECT_EQ(request.surface.roughness, 0.5F);
  EXPECT_EQ(request.surface.ior, 1.25F);
  EXPECT_EQ(request.where.beside_m, -0.5F);
  expect_no_insertion(R"({"object": "cube", "kind": "wood"})", "diffuse, metal, plastic, glass");
  expect_no_insertion(R"({"object": "cube", "kind": 1})", "'kind'");
  for (const std::string colour : {"[1, 0]", "[1, 0, 0, 0]", "\"#ff0000\"", "[1, 0, \"0\"]", "null", "{\"r\": 1}"})
    expect_no_insertion("{\"object\": \"cube\", \"colour_rgb\": " + colour + "}", "'colour_rgb'");
  expect_no_insertion(R"({"object": "cube", "roughness": "0.5"})", "'roughness'");
  expect_no_insertion(R"({"object": "cube", "index": [1]})", "'index'");
  expect_no_insertion(R"({"object": "cube", "beside_m": "1"})", "'beside_m'");
  // Read, and refused where it is checked.
  EXPECT_NE(read_insertion_request(R"({"object": "cube", "roughness": 2})").surface.validate(), "");
  EXPECT_NE(read_insertion_request(R"({"object": "cube", "colour_rgb": [0, 1e300, 0]})").surface.validate(), "");
}

TEST(InsertionRequests, WhatIsLeftOutIsAsInTheCommand) {
  const InsertionRequest request = read_insertion_request(R"({"object": "cube"})");
  const pipeline::InsertionOptions usual;
  EXPECT_EQ(request.material, "");
  EXPECT_TRUE(request.surface.empty());
  EXPECT_FALSE(request.where.beside_m || request.where.at_px || request.where.depth_m || request.where.height_m ||
               request.where.face);
  EXPECT_EQ(request.where.joint_light, usual.joint_light);
  EXPECT_EQ(request.where.turn_deg, usual.turn_deg);
  EXPECT_EQ(request.where.ground, usual.ground);
  EXPECT_FALSE(request.preview);
  EXPECT_EQ(request.where.validate(), "");
}

TEST(InsertionRequests, EveryObjectAndMaterialCanBeNamed) {
  for (const std::string& object : render::shape_names()) {
    for (const std::string& material : render::material_preset_names()) {
      const Json body = {{"object", object}, {"material", material}};
      const InsertionRequest request = read_insertion_request(body.dump());
      EXPECT_EQ(request.object, object);
      EXPECT_EQ(request.material, material);
    }
  }
}

TEST(InsertionRequests, UnknownKeysAreNamed) {
  expect_no_insertion(R"({"object": "cube", "colour": "red"})", "'colour'");
  expect_no_insertion(R"({"object": "cube", "Ground": true})", "'Ground'");
  expect_no_insertion(R"({"object": "cube", "matte": "/etc/passwd"})", "'matte'");
}

TEST(InsertionRequests, WrongTypesAreNamed) {
  expect_no_insertion(R"({"object": 3})", "'object'");
  expect_no_insertion(R"({"object": ["cube"]})", "'object'");
  expect_no_insertion(R"({"object": "cube", "material": null})", "'material'");
  expect_no_insertion(R"({"object": "cube", "at_px": 3})", "'at_px'");
  expect_no_insertion(R"({"object": "cube", "at_px": [1]})", "'at_px'");
  expect_no_insertion(R"({"object": "cube", "at_px": [1, 2, 3]})", "'at_px'");
  expect_no_insertion(R"({"object": "cube", "at_px": [1, "2"]})", "'at_px'");
  expect_no_insertion(R"({"object": "cube", "at_px": {"x": 1, "y": 2}})", "'at_px'");
  expect_no_insertion(R"({"object": "cube", "distance_m": "1"})", "'distance_m'");
  expect_no_insertion(R"({"object": "cube", "height_m": true})", "'height_m'");
  expect_no_insertion(R"({"object": "cube", "turn_deg": [0]})", "'turn_deg'");
  expect_no_insertion(R"({"object": "cube", "ground": 1})", "'ground'");
  for (const std::string face : {"-1", "0.5", "1.0", "1e300", "18446744073709551615", "\"0\"", "null", "[0]"})
    expect_no_insertion("{\"object\": \"cube\", \"face\": " + face + "}", "'face'");
  expect_no_insertion(R"({"object": "cube", "joint_light": "yes"})", "'joint_light'");
  expect_no_insertion(R"({"object": "cube", "quality": 1})", "'quality'");
  expect_no_insertion(R"({"object": "cube", "quality": "best"})", "preview or final");
}

TEST(InsertionRequests, ThatAreNoJsonObjectAreRefused) {
  for (const std::string body : {"", " ", "null", "3", "\"cube\"", "[]", "{", "{\"object\": \"cube\"", "{}}",
                                 "object=cube", "{\"object\": \"cube\"} {}", "{'object': 'cube'}"})
    expect_no_insertion(body, "JSON object");
  expect_no_insertion("{}", "object");
}

TEST(InsertionRequests, NumbersThatAreNoneAreRefused) {
  for (const std::string number : {"1e999", "-1e999", "NaN", "Infinity", "+1", "0x10", "1.", "01"})
    expect_no_insertion("{\"object\": \"cube\", \"distance_m\": " + number + "}", "JSON object");
}

// Doubles that no float holds are read, and refused by the options.
TEST(InsertionRequests, NumbersBeyondAllMeasureDoNotValidate) {
  for (const std::string number : {"1e300", "-1e300", "1e39", "0", "-1"}) {
    for (const std::string key : {"distance_m", "height_m"}) {
      const auto request = read_insertion_request("{\"object\": \"cube\", \"" + key + "\": " + number + "}");
      EXPECT_NE(request.where.validate(), "") << key << " " << number;
    }
  }
  EXPECT_NE(read_insertion_request(R"({"object": "cube", "turn_deg": 1e300})").where.validate(), "");
  EXPECT_NE(read_insertion_request(R"({"object": "cube", "at_px": [1e300, 0]})").where.validate(), "");
}

// The command takes files as objects; here they would be this machine's.
TEST(InsertionRequests, FilesAreNoObjects) {
  for (const std::string name : {"../x.obj", "/etc/passwd", "cube.obj", "file:///x.ply", "x.glb", "./cube", "cube/",
                                 "Cube", "", " cube", "cube\\u0000"})
    expect_no_insertion("{\"object\": \"" + name + "\"}", "sphere, cube");
  for (const std::string name : {"../x.mtl", "/etc/passwd", "Gold", "gold "})
    expect_no_insertion("{\"object\": \"cube\", \"material\": \"" + name + "\"}", "gold");
}

TEST(InsertionRequests, DeepNestingIsNoDanger) {
  const std::string open(60'000, '[');
  const std::string close(60'000, ']');
  expect_no_insertion(open, "JSON object");
  expect_no_insertion("{\"object\": " + open + close + "}", "'object'");
  expect_no_insertion("{\"object\": \"cube\", \"deep\": " + open + close + "}", "'deep'");
  std::string objects;
  for (int i = 0; i < 10'000; ++i) objects += "{\"a\":";
  expect_no_insertion(objects + "1" + std::string(10'000, '}'), "object");
}

TEST(InsertionRequests, OnlyUtf8IsRead) {
  expect_no_insertion("{\"object\": \"cube\xFF\"}", "UTF-8");
  expect_no_insertion("{\"object\": \"cub\xC3\"}", "UTF-8");
  expect_no_insertion("{\"obj\xFF\": \"cube\"}", "UTF-8");
  expect_no_insertion(std::string("\xFF\xFE{\0}\0", 6), "UTF-8");
}

TEST(SampleRequests, AreANameAndNothingElse) {
  EXPECT_EQ(read_sample_request(R"({"sample": "grace_hopper"})"), "grace_hopper");
  EXPECT_EQ(read_sample_request(R"({"sample": "../x.jpg"})"),
            "../x.jpg");  // no sample has that name, see upload_test.cpp
  expect_no_sample("{}", "'sample'");
  expect_no_sample(R"({"sample": ""})", "'sample'");
  expect_no_sample(R"({"sample": 1})", "'sample'");
  expect_no_sample(R"({"sample": "grace_hopper", "name": "x"})", "'name'");
  expect_no_sample("grace_hopper", "JSON object");
}

TEST(ShownNames, ControlCharactersBecomeSpaces) {
  EXPECT_EQ(shown_name("holiday.jpg"), "holiday.jpg");
  EXPECT_EQ(shown_name("a\r\nb\tc\x7F.jpg"), "a  b c .jpg");
  EXPECT_EQ(shown_name(std::string("a\0b", 3)), "a b");
  EXPECT_EQ(shown_name("../../etc/passwd"), "../../etc/passwd");  // shown, never a path
  EXPECT_EQ(shown_name("Grüße 写真.jpg"), "Grüße 写真.jpg");
}

TEST(ShownNames, NothingIsCalledPhoto) { EXPECT_EQ(shown_name(""), "photo"); }

TEST(ShownNames, LongOnesAreCutAtACharactersEdge) {
  EXPECT_EQ(shown_name(std::string(120, 'x')), std::string(120, 'x'));
  EXPECT_EQ(shown_name(std::string(5000, 'x')), std::string(120, 'x'));
  // A character of two, three and four bytes, with each of its bytes at the edge.
  for (const std::string character : {"ü", "写", "😀"}) {
    for (std::size_t before = 110; before <= 125; ++before) {
      const std::string name = shown_name(std::string(before, 'x') + character + std::string(20, 'y'));
      EXPECT_LE(name.size(), 120U);
      EXPECT_GT(name.size(), 120U - character.size());
      const bool whole = before + character.size() <= 120;
      EXPECT_EQ(name.find(character) != std::string::npos, whole) << before;
      EXPECT_EQ(name.find_first_not_of("xy") == std::string::npos, !whole) << before << ": half a character is left";
    }
  }
}

// No characters, but nothing to fail at either.
TEST(ShownNames, BytesThatAreNoUtf8AreTaken) {
  EXPECT_LE(shown_name(std::string(5000, '\xFF')).size(), 120U);
  EXPECT_EQ(shown_name(std::string(5000, '\x80')), "photo");
}

}  // namespace
}  // namespace faceprobe::serve
