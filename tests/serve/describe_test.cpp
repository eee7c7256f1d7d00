#include "serve/describe.h"

#include "faceprobe/render/shapes.h"
#include "serve/contract.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace faceprobe::serve {
namespace {

using faceprobe::testing::TempFolder;
using testing::Contract;

using Faults = std::vector<std::string>;

// A face 120 px wide whose mesh points fill its box, row by row.
pipeline::FaceEstimate gridded_face(float left, const Eigen::Vector3d& place_m) {
  pipeline::FaceEstimate face;
  face.face.camera_from_face.translation() = place_m;
  face.face.box = {left, 100, 120, 150};
  face.face.landmarks_px.resize(face::kMeshVertices, 3);
  for (int i = 0; i < face::kMeshVertices; ++i) {
    const auto step = static_cast<float>(i);
    face.face.landmarks_px.row(i) << left + 120 * step / face::kMeshVertices, 100 + 150 * step / face::kMeshVertices,
        -step;
  }
  face.geometry.crop = {.x_px = left - 20.5, .y_px = -8, .scale = 0.5, .width = 80, .height = 97};
  face.environment = face.confidence = EnvMap(Image(32, 16, 3, 1.0F));
  return face;
}

// An estimate that is done, of one face or of two.
struct Described {
  explicit Described(bool two = false) {
    pipeline::Estimate& estimate = record.estimate;
    estimate.photo_width = 640;
    estimate.photo_height = 480;
    estimate.camera = {800, 320, 240};
    estimate.faces.push_back(gridded_face(40, {-0.3, 0, -0.8}));
    if (two) {
      estimate.faces.push_back(gridded_face(400, {0.3, 0, -0.9}));
      estimate.joint = estimate.faces[0];
    }
    record.files = {{"environment.exr", 17}, {"report.json", 4}};
    io::Photo photo;
    photo.linear = Image(640, 480, 3, 0.4F);
    const pipeline::Room room;
    record.described = describe(record, photo, {}, two ? &room : nullptr);
    record.job.succeed();
  }

  TempFolder folder;
  EstimateRecord record{new_id(), "holiday.jpg", folder.path(), false};
};

TEST(Describe, AnEstimateIsAsLaidDown) {
  const Contract contract;
  for (const bool two : {false, true}) {
    const Described described(two);
    EXPECT_EQ(contract.faults_of(estimate_json(described.record), contract.schema("Estimate"), "it"), Faults());
    EXPECT_EQ(contract.faults_of(summary_json(described.record), contract.schema("EstimateSummary"), "it"), Faults());
  }
}

TEST(Describe, OneFaceHasNoFolderNoJointLightAndNoRoom) {
  const Described described;
  const Json json = estimate_json(described.record);
  EXPECT_EQ(json["name"], "holiday.jpg");
  EXPECT_EQ(json["id"], described.record.id);
  EXPECT_EQ(json["photo"], (Json{{"width_px", 640}, {"height_px", 480}}));
  EXPECT_EQ(json["faces"].size(), 1U);
  EXPECT_EQ(json["faces"][0]["folder"], "");
  EXPECT_TRUE(json["joint_folder"].is_null());
  EXPECT_TRUE(json["room"].is_null());
  EXPECT_EQ(json["report"]["schema"], "faceprobe-report/1");
  EXPECT_EQ(summary_json(described.record)["faces"], 1);
}

TEST(Describe, SeveralFacesHaveFoldersAJointLightAndARoom) {
  const Described described(true);
  const Json json = estimate_json(described.record);
  ASSERT_EQ(json["faces"].size(), 2U);
  EXPECT_EQ(json["faces"][0]["folder"], "face_1");
  EXPECT_EQ(json["faces"][1]["folder"], "face_2");
  EXPECT_EQ(json["joint_folder"], "joint");
  EXPECT_TRUE(json["room"].is_object());
  EXPECT_EQ(summary_json(described.record)["faces"], 2);
}

TEST(Describe, AMeshIsTheXAndYOfEachPointInTurn) {
  const Described described(true);
  for (std::size_t f = 0; f < 2; ++f) {
    const face::Face& face = described.record.estimate.faces[f].face;
    const Json json = estimate_json(described.record)["faces"][f];
    EXPECT_EQ(json["box_px"], (Json{face.box.x, face.box.y, face.box.width, face.box.height}));
    ASSERT_EQ(json["mesh_px"].size(), 936U);
    for (int i = 0; i < face::kMeshVertices; ++i) {
      const auto at = static_cast<std::size_t>(2 * i);
      ASSERT_EQ(json["mesh_px"][at].get<float>(), face.landmarks_px(i, 0));
      ASSERT_EQ(json["mesh_px"][at + 1].get<float>(), face.landmarks_px(i, 1));
    }
  }
}

TEST(Describe, ACropIsThePartOfThePhotoThatTheLayersShow) {
  const Described described(true);
  const Json json = estimate_json(described.record);
  // 80 x 97 px of a crop at half the photo's scale; its top is beyond the photo.
  EXPECT_EQ(json["faces"][0]["crop_px"], (Json{19.5, -8, 160, 194}));
  EXPECT_EQ(json["faces"][1]["crop_px"], (Json{379.5, -8, 160, 194}));
}

TEST(Describe, NothingOfAnEstimateIsToldBeforeItIsDone) {
  const TempFolder folder;
  EstimateRecord record(new_id(), "holiday.jpg", folder.path(), false);
  record.described = {{"faces", Json::array()}};
  for (const char* key : {"faces", "photo", "files"}) EXPECT_FALSE(estimate_json(record).contains(key)) << key;
  EXPECT_FALSE(summary_json(record).contains("faces"));
  record.job.fail({FailureKind::kNoFace, "No face."});
  EXPECT_FALSE(estimate_json(record).contains("faces"));
  EXPECT_EQ(estimate_json(record)["job"]["error"]["kind"], "no_face");
}

TEST(Describe, AnInsertionHasFilesOnceItIsDone) {
  const Contract contract;
  const TempFolder folder;
  const auto estimate = std::make_shared<EstimateRecord>(new_id(), "holiday.jpg", folder.path(), false);
  InsertionRecord record(new_id(), estimate);
  record.files = {{"composite.png", 99}};
  EXPECT_FALSE(insertion_json(record).contains("files"));
  EXPECT_EQ(contract.faults_of(insertion_json(record), contract.schema("Insertion"), "it"), Faults());
  record.job.succeed();
  const Json json = insertion_json(record);
  EXPECT_EQ(contract.faults_of(json, contract.schema("Insertion"), "it"), Faults());
  EXPECT_EQ(json["estimate"], estimate->id);
  EXPECT_EQ(json["files"], (Json{{{"path", "composite.png"}, {"bytes", 99}, {"media_type", "image/png"}}}));
}

TEST(Describe, MediaTypesAreToldByTheEnd) {
  EXPECT_EQ(media_type("face_1/environment.exr"), "image/x-exr");
  EXPECT_EQ(media_type("room.gltf"), "model/gltf+json");
  EXPECT_EQ(media_type("report.json"), "application/json");
  EXPECT_EQ(media_type(".png"), "image/png");
  EXPECT_EQ(media_type("png"), "application/octet-stream");
  EXPECT_EQ(media_type("a.png.bin"), "application/octet-stream");
  EXPECT_EQ(media_type(""), "application/octet-stream");
}

// The triangles of a mesh point to its vertices, and every vertex has a unit normal.
void expect_drawable(const Json& mesh, std::size_t materials) {
  EXPECT_LT(mesh["material"].get<std::size_t>(), materials);
  ASSERT_EQ(mesh["positions"].size() % 3, 0U);
  ASSERT_EQ(mesh["normals"].size(), mesh["positions"].size());
  ASSERT_EQ(mesh["triangles"].size() % 3, 0U);
  const auto indices = mesh["triangles"].get<std::vector<int>>();
  const auto normals = mesh["normals"].get<std::vector<double>>();
  const int vertices = static_cast<int>(mesh["positions"].size() / 3);
  ASSERT_GT(indices.size(), 0U);
  EXPECT_GE(*std::ranges::min_element(indices), 0);
  EXPECT_LT(*std::ranges::max_element(indices), vertices);
  for (std::size_t i = 0; i < normals.size(); i += 3)
    ASSERT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-5);  // floats
}

// Six times the volume, which is positive when triangles are counter-clockwise seen from outside.
double volume(const Json& mesh) {
  const auto positions = mesh["positions"].get<std::vector<double>>();
  const auto corner = [&](std::size_t index) { return Eigen::Map<const Eigen::Vector3d>(&positions[3 * index]); };
  const auto indices = mesh["triangles"].get<std::vector<std::size_t>>();
  double sum = 0;
  for (std::size_t t = 0; t < indices.size(); t += 3)
    sum += corner(indices[t]).dot(corner(indices[t + 1]).cross(corner(indices[t + 2])));
  return sum;
}

TEST(Describe, ObjectsCanBeDrawnFromTheirNumbers) {
  for (const std::string& name : render::shape_names()) {
    const render::Model model = render::shape(name);
    const Json json = object_json(name, model);
    EXPECT_EQ(json["name"], name);
    ASSERT_EQ(json["meshes"].size(), model.meshes.size());
    ASSERT_EQ(json["materials"].size(), model.materials.size());
    double all = 0;
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
      const Json& mesh = json["meshes"][m];
      expect_drawable(mesh, model.materials.size());
      all += volume(mesh);
      const render::TriangleMesh& of = model.meshes[m];
      const Eigen::Index last = of.vertices.rows() - 1;
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(mesh["positions"][static_cast<std::size_t>(3 * last + axis)].get<float>(), of.vertices(last, axis));
    }
    EXPECT_GT(all, 0) << name;
  }
}

TEST(Describe, EveryMaterialIsAsLaidDown) {
  const Contract contract;
  std::set<std::string> kinds;
  for (const std::string& name : render::material_preset_names()) {
    const render::Material material = render::material_preset(name);
    const Json json = material_json(material);
    EXPECT_EQ(contract.faults_of(json, contract.schema("Material"), name), Faults());
    EXPECT_EQ(json["colour_rgb"].size(), 3U);
    EXPECT_EQ(json["roughness"].get<float>(), material.roughness);
    kinds.insert(json["kind"]);
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"diffuse", "glass", "metal", "plastic"}));
}

}  // namespace
}  // namespace faceprobe::serve
