#include "faceprobe/pipeline/insertion.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/insertion_files.h"
#include "faceprobe/render/shapes.h"
#include "pipeline/placed_things.h"
#include "support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace faceprobe::pipeline {
namespace {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;
using testing::even_map;
using testing::face_at;
using testing::kDepthM;
using testing::marker;
using testing::only_face;
using testing::photo_of;
using testing::pixel_of;
using testing::vertex;

// What the model covers of the picture.
Eigen::AlignedBox2d seen_box(const insert::Scene& scene) {
  Eigen::AlignedBox2d box;
  for (const render::TriangleMesh& mesh : scene.model.meshes) {
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i)
      box.extend(pixel_of(scene.view, mesh.vertices.row(i).transpose()));
  }
  return box;
}

// The whole of the object is in the picture, low and on the side that the face leaves.
void expect_in_corner(const Estimate& estimate, const std::string& shape, float turn_deg, bool right) {
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, render::shape(shape), {.turn_deg = turn_deg});
  const Eigen::AlignedBox2d box = seen_box(scene);
  const Eigen::Vector2d size(estimate.photo_width, estimate.photo_height);
  EXPECT_TRUE(Eigen::AlignedBox2d(Eigen::Vector2d::Zero(), size).contains(box))
      << shape << ' ' << turn_deg << ": " << box.min().transpose() << " to " << box.max().transpose();
  EXPECT_EQ(box.center().x() > 0.5 * size.x(), right) << shape;
  EXPECT_GT(box.center().y(), 0.5 * size.y()) << shape;
  EXPECT_GT(scene.model.box().min().z(), -kDepthM) << shape;  // nearer than the face
}

TEST(Insertion, StandsWhereThereIsMoreRoomUnlessTold) {
  for (const auto& [width, height] : {std::pair(640, 480), std::pair(480, 640)}) {
    for (const double focal_px : {800.0, 480.0}) {  // a portrait lens, a telephone's
      for (const bool face_left : {true, false}) {
        Estimate estimate = only_face(face_left ? 40.0F : static_cast<float>(width) - 160, width, height);
        estimate.camera.focal_px = focal_px;
        for (const std::string& shape : render::shape_names()) {
          for (const float turn_deg : {0.0F, 40.0F, 90.0F}) expect_in_corner(estimate, shape, turn_deg, face_left);
        }
      }
    }
  }
}

TEST(Insertion, IsAThirdOfThePictureLargeUnlessTold) {
  const Estimate estimate = only_face(40);
  for (const char* name : {"sphere", "robot", "spheres"}) {
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, render::shape(name));
    const Eigen::Vector3f size = scene.model.box().sizes();
    const double longer_px =
        std::max<double>(size.y(), std::hypot(size.x(), size.z())) * 800 / (0.75 * static_cast<double>(kDepthM));
    EXPECT_NEAR(longer_px, 480.0 / 3, 0.1 * 480 / 3) << name;  // a rule of thumb: a tenth is not seen
  }
}

TEST(Insertion, TheSpotIsWhereTheSceneHasIt) {
  const Estimate estimate = only_face(60);
  const Spot spot = spot_for(estimate, marker());
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker());
  EXPECT_NEAR((pixel_of(scene.view, vertex(scene, 0)) - spot.at_px).norm(), 0, 0.01);  // floats
  EXPECT_NEAR(-vertex(scene, 0).z(), spot.depth_m, 1e-5);
  EXPECT_NEAR((vertex(scene, 1) - vertex(scene, 0)).norm(), spot.height_m, 1e-5);
}

TEST(Insertion, StandsWhereItIsTold) {
  const Estimate estimate = only_face(40);
  for (const auto& [x, y] : {std::pair(100.0, 400.0), std::pair(600.5, 20.25), std::pair(320.0, 240.0)}) {
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(),
                                          {.at_px = Eigen::Vector2d(x, y), .depth_m = 1.5F, .height_m = 0.3F});
    EXPECT_NEAR((pixel_of(scene.view, vertex(scene, 0)) - Eigen::Vector2d(x, y)).norm(), 0,
                1e-3);                                // float metres at 800 px
    EXPECT_NEAR(-vertex(scene, 0).z(), 1.5F, 1e-6F);  // one rounding
    EXPECT_NEAR((vertex(scene, 1) - vertex(scene, 0) - Eigen::Vector3f(0, 0.3F, 0)).norm(), 0, 1e-6F);
  }
}

TEST(Insertion, StandsBesideTheFaceByMetres) {
  Estimate estimate = only_face(40);
  estimate.faces[0].face.camera_from_face.translation() = Eigen::Vector3d(0.05, 0.1, -kDepthM);
  estimate.faces.push_back(face_at({-0.1, 0, -1.6}, 200, 60));
  const auto foot_of = [&](const InsertionOptions& options) {
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), options);
    const Eigen::Vector2d seen = pixel_of(scene.view, vertex(scene, 0));
    EXPECT_GT(seen.y(), 0.6 * 480);
    EXPECT_LT(seen.y(), 480);
    return vertex(scene, 0);
  };
  for (const float beside : {0.2F, 0.0F, -0.3F}) {
    const Eigen::Vector3f foot = foot_of({.beside_m = beside});
    EXPECT_NEAR(foot.x(), 0.05F + beside, 1e-5F);  // floats, by way of pixels
    EXPECT_NEAR(foot.z(), -kDepthM, 1e-6F);
    // In front of it or behind it, as far to its side.
    const Eigen::Vector3f nearer = foot_of({.beside_m = beside, .depth_m = 0.5F});
    EXPECT_NEAR(nearer.x(), 0.05F + beside, 1e-5F);
    EXPECT_NEAR(nearer.z(), -0.5F, 1e-6F);
    const Eigen::Vector3f other = foot_of({.beside_m = beside, .face = 1});
    EXPECT_NEAR(other.x(), -0.1F + beside, 1e-5F);
    EXPECT_NEAR(other.z(), -1.6F, 1e-6F);
  }
  // Where that is in the photo: 800 px / .8 m, from the middle at 320.
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), {.beside_m = 0.2F});
  EXPECT_NEAR(pixel_of(scene.view, vertex(scene, 0)).x(), 320 + 800 * 0.25 / 0.8, 0.01);
}

TEST(Insertion, TurnsItsFrontToTheRightOfThePhoto) {
  const Estimate estimate = only_face(40);
  for (const float turn_deg : {0.0F, 30.0F, 90.0F, -120.0F}) {
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), {.turn_deg = turn_deg});
    const auto turn = static_cast<float>(radians(turn_deg));
    const Eigen::Vector3f front = (vertex(scene, 2) - vertex(scene, 0)).normalized();
    EXPECT_NEAR((front - Eigen::Vector3f(std::sin(turn), 0, std::cos(turn))).norm(), 0, 1e-5)
        << turn_deg;  // floats of .1 m, some .5 m away
  }
}

TEST(Insertion, UpIsToldByTheHeadsOrTheHorizon) {
  Estimate estimate = only_face(40);
  const Eigen::Matrix3d roll = Eigen::AngleAxisd(radians(-20.0), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  estimate.faces[0].face.camera_from_face.linear() = roll;  // the crown to the right of the photo
  const auto lean_deg = [](const Eigen::Vector3f& up) {
    return degrees(std::atan2(static_cast<double>(up.x()), static_cast<double>(up.y())));
  };
  const insert::Scene by_head = scene_for(photo_of(estimate), estimate, marker());
  EXPECT_NEAR(lean_deg(by_head.up), 20 * 64.0 / 208,
              0.1);  // the head's share, see insert/spot.h; vectors are averaged, not angles
  EXPECT_NEAR(((vertex(by_head, 1) - vertex(by_head, 0)).normalized() - by_head.up).norm(), 0, 1e-5);

  // A second head that agrees has a say.
  estimate.faces.push_back(estimate.faces[0]);
  EXPECT_NEAR(lean_deg(scene_for(photo_of(estimate), estimate, marker()).up), 20 * 64.0 / 136, 0.1);

  const insert::Scene level = scene_for(photo_of(estimate), estimate, marker(), {.horizon_px = 240});
  EXPECT_NEAR((level.up - Eigen::Vector3f::UnitY()).norm(), 0, 1e-6);  // a horizon in the middle, whatever heads do
  const insert::Scene looking_down = scene_for(photo_of(estimate), estimate, marker(), {.horizon_px = 40});
  EXPECT_NEAR(looking_down.up.x(), 0, 1e-6);
  EXPECT_NEAR(looking_down.up.z() / looking_down.up.y(), 200.0 / 800, 1e-5);  // floats
  EXPECT_NEAR(((vertex(looking_down, 1) - vertex(looking_down, 0)).normalized() - looking_down.up).norm(), 0, 1e-5);
}

TEST(Insertion, TheViewAndTheGroundAreTheEstimates) {
  Estimate estimate = only_face(40);
  estimate.camera.centre_x_px = 300;
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker());
  EXPECT_EQ(scene.view.focal_px, 800);
  EXPECT_EQ(scene.view.centre_x_px, 300);
  EXPECT_EQ(scene.view.width_px, 640);
  EXPECT_EQ(scene.view.height_px, 480);
  EXPECT_TRUE(scene.ground);
  EXPECT_FALSE(scene_for(photo_of(estimate), estimate, marker(), {.ground = false}).ground);
}

TEST(Insertion, AMatteOfAnotherSizeIsASentence) {
  const Estimate estimate = only_face(40);
  for (const Image& matte : {Image(480, 640, 1), Image(640, 479, 1), Image(640, 480, 3)}) {
    expect_error(ExitCode::kUsage, {"matte", "640 x 480"},
                 [&] { scene_for(photo_of(estimate), estimate, marker(), {.matte = matte}); });
  }
}

TEST(Insertion, AGivenMatteIsUsedAtTheLargestFacesDepth) {
  Estimate estimate = only_face(40);
  Image matte(640, 480, 1);
  matte(3, 4) = 0.5F;
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker(), {.matte = matte});
  ASSERT_TRUE(scene.matte);
  EXPECT_EQ(scene.matte->cover, matte);
  EXPECT_FLOAT_EQ(scene.matte->depth_m(3, 4), kDepthM);
}

// A crop of 40 x 40 px with a disc of face in it, over 80 x 80 px of the photo.
void give_disc(FaceEstimate& face, double x_px, double y_px) {
  face.geometry.crop = {x_px, y_px, 0.5, 40, 40};
  face.geometry.region = ByteImage(40, 40, 1);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (std::hypot(x + 0.5 - 20, y + 0.5 - 20) < 15)
        face.geometry.region(x, y) = static_cast<std::uint8_t>(Region::kCheeks);
    }
  }
}

TEST(Insertion, TheFacesAreTheMatte) {
  Estimate estimate = only_face(100);
  give_disc(estimate.faces[0], -20, 60);  // a part of the crop is outside the photo
  const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker());
  ASSERT_TRUE(scene.matte);
  ASSERT_TRUE(scene.matte->cover.same_size(photo_of(estimate).linear));
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double from_middle = std::hypot(x + 0.5 - 20, y + 0.5 - 100);
      if (std::abs(from_middle - 30) < 2) continue;  // pixels of the crop are 2 px wide
      ASSERT_EQ(scene.matte->cover(x, y), from_middle < 30 ? 1.0F : 0.0F) << x << ' ' << y;
      if (from_middle < 30) {
        ASSERT_FLOAT_EQ(scene.matte->depth_m(x, y), kDepthM);
      }
    }
  }
}

TEST(Insertion, OfTwoFacesTheNearerHidesTheOther) {
  for (const bool nearer_first : {true, false}) {
    Estimate estimate = only_face(100);
    estimate.faces.push_back(face_at({0.1, 0, -1.4}, 400, 80));
    give_disc(estimate.faces[0], 200, 100);
    give_disc(estimate.faces[1], 240, 100);
    if (!nearer_first) std::swap(estimate.faces[0], estimate.faces[1]);
    const insert::Scene scene = scene_for(photo_of(estimate), estimate, marker());
    EXPECT_FLOAT_EQ(scene.matte->depth_m(220, 140), 0.8F);
    EXPECT_FLOAT_EQ(scene.matte->depth_m(260, 140), 0.8F);  // both are here
    EXPECT_FLOAT_EQ(scene.matte->depth_m(300, 140), 1.4F);
  }
}

TEST(Insertion, ThePortraitsMatteIsTheManAndNotTheWall) {
  const Estimate& estimate = testing::portrait_estimate();
  const insert::Scene scene = scene_for(testing::portrait(), estimate, render::sphere());
  ASSERT_TRUE(scene.matte);
  const face::Face& face = estimate.faces[0].face;
  for (const int landmark : {1, 10, 152, 50, 280}) {  // nose, forehead, chin, cheeks
    const auto x = static_cast<int>(face.landmarks_px(landmark, 0));
    const auto y = static_cast<int>(face.landmarks_px(landmark, 1));
    EXPECT_EQ(scene.matte->cover(x, y), 1) << landmark;
    EXPECT_NEAR(scene.matte->depth_m(x, y), -face.position_m().z(), 1e-5);
  }
  for (const int x : {2, 509}) EXPECT_EQ(scene.matte->cover(x, 2), 0);  // the picture's upper corners
  EXPECT_EQ(scene.environment.radiance(), estimate.faces[0].environment.radiance());
  EXPECT_TRUE(scene.lamps.empty());  // one face knows no places of lamps
}

TEST(Insertion, TheNearestFacesMapIsTaken) {
  Estimate estimate = only_face(100);
  estimate.faces[0] = face_at({-0.3, 0, -1}, 80, 120);
  estimate.faces.push_back(face_at({0.4, 0, -1.5}, 450, 90));
  estimate.faces[0].environment = even_map(2);
  estimate.faces[1].environment = even_map(3);
  const auto value = [&](const Eigen::Vector2d& at, float depth_m) {
    return scene_for(photo_of(estimate), estimate, marker(), {.at_px = at, .depth_m = depth_m})
        .environment.radiance()(5, 5, 1);
  };
  EXPECT_EQ(value({100, 300}, 1), 2);
  EXPECT_EQ(value({540, 300}, 1.5F), 3);
  EXPECT_EQ(value({320, 240}, 1), 2);  // .3 m from the one, .64 from the other
}

TEST(InsertionOptions, SayWhatIsWrong) {
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  const auto infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(InsertionOptions{}.validate(), "");
  EXPECT_EQ((InsertionOptions{.at_px = Eigen::Vector2d(-5, 9000), .depth_m = 0.1F, .height_m = 999.0F, .horizon_px = -50}
                 .validate()),
            "");
  const auto faults = [](const InsertionOptions& options, const std::string& text) {
    EXPECT_NE(options.validate().find(text), std::string::npos)
        << '"' << options.validate() << "\" does not say " << text;
    const Estimate estimate = only_face(40);
    expect_error(ExitCode::kUsage, {text}, [&] { scene_for(photo_of(estimate), estimate, marker(), options); });
  };
  faults({.at_px = Eigen::Vector2d(infinite, 3)}, "place");
  faults({.at_px = Eigen::Vector2d(std::numeric_limits<double>::quiet_NaN(), 3)}, "place");
  for (const float wrong : {0.0F, -1.0F, 1000.0F, nan}) {
    faults({.depth_m = wrong}, "distance");
    faults({.height_m = wrong}, "height");
  }
  faults({.depth_m = -2.5F}, "-2.5");
  for (const float wrong : {101.0F, -1e9F, nan}) faults({.beside_m = wrong}, "beside");
  faults({.at_px = Eigen::Vector2d(3, 3), .beside_m = 0.2F}, "twice");
  faults({.turn_deg = nan}, "turn");
  faults({.horizon_px = infinite}, "horizon");
}

// A white ball under an even sky, drawn with few rays.
struct Drawn {
  Estimate estimate = only_face(8, 96, 72);
  insert::Scene scene;
  insert::Insertion done;

  Drawn() {
    estimate.camera.focal_px = 120;
    render::Model ball = render::sphere();
    ball.materials = {render::material_preset("diffuse")};
    for (render::TriangleMesh& mesh : ball.meshes) mesh.material = 0;
    scene = scene_for(photo_of(estimate), estimate, ball,
                      {.at_px = Eigen::Vector2d(70, 60), .depth_m = 1, .height_m = 0.2F, .turn_deg = 0});
    scene.lamps.push_back({.position_m = {0, 1, -1}, .radius_m = 0.1F, .intensity = {1, 2, 3}});
    insert::Options options;
    options.render.samples = 4;
    options.render.noise = 0;
    options.match_blur = options.match_grain = false;
    done = insert::insert_model(photo_of(estimate).linear, scene, options);
  }
};

TEST(InsertionFiles, TheJsonSaysWhatStandsWhereInWhichLight) {
  const Drawn drawn;
  const auto json = nlohmann::json::parse(insertion_json(drawn.done, drawn.scene, "a \"photo\".jpg", "ball.ply"));
  EXPECT_EQ(json["schema"], "faceprobe-insert/1");
  EXPECT_EQ(json["program"]["name"], "faceprobe");
  EXPECT_EQ(json["photo"], "a \"photo\".jpg");
  EXPECT_EQ(json["object"], "ball.ply");
  const Eigen::AlignedBox3f box = drawn.scene.model.box();
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(json["object_box_m"]["min"][i].get<float>(), box.min()[i]);
    EXPECT_EQ(json["object_box_m"]["max"][i].get<float>(), box.max()[i]);
    EXPECT_EQ(json["up"][i].get<float>(), drawn.scene.up[i]);
    EXPECT_EQ(json["ground"]["albedo"][i].get<float>(), drawn.done.ground_albedo[i]);
    EXPECT_EQ(json["lamps"][0]["intensity"][i].get<float>(), static_cast<float>(i + 1));
  }
  EXPECT_EQ(json["lamps"][0]["position_m"][1], 1);
  EXPECT_EQ(json["lamps"][0]["radius_m"].get<float>(), 0.1F);
  EXPECT_EQ(json["triangles"], drawn.scene.model.triangle_count());
  EXPECT_EQ(json["box_px"]["left"], drawn.done.box.left);
  EXPECT_EQ(json["box_px"]["top"], drawn.done.box.top);
  EXPECT_EQ(json["box_px"]["width"], drawn.done.box.width());
  EXPECT_EQ(json["box_px"]["height"], drawn.done.box.height());
  EXPECT_EQ(json["blur_px"], 0);
  EXPECT_EQ(json["grain_sigma"].size(), 5U);
  EXPECT_EQ(json["complete"], true);

  insert::Scene floating = drawn.scene;
  floating.ground = false;
  insert::Insertion stopped = drawn.done;
  stopped.stopped = true;
  const auto other = nlohmann::json::parse(insertion_json(stopped, floating, "a", "b"));
  EXPECT_TRUE(other["ground"].is_null());
  EXPECT_EQ(other["complete"], false);
}

TEST(InsertionFiles, NamesThatAreNotUtf8AreNoError) {
  const Drawn drawn;
  const auto json = nlohmann::json::parse(insertion_json(drawn.done, drawn.scene, "a\xFF.jpg", "b\xFF.ply"));
  EXPECT_EQ(json["photo"], "a\uFFFD.jpg");
  EXPECT_EQ(json["object"], "b\uFFFD.ply");
}

TEST(InsertionFiles, AreTheListedOnesInThePhotosSize) {
  const Drawn drawn;
  const TempFolder folder;
  const auto files = write_insertion(folder / "new/one", drawn.done, drawn.scene, "photo.jpg", "ball");
  std::vector<std::string> told;
  for (const auto& file : files) {
    EXPECT_EQ(file.parent_path(), folder / "new/one");
    told.push_back(file.filename().string());
  }
  EXPECT_EQ(told, (std::vector<std::string>{"composite.png", "composite.exr", "object.png", "object.exr", "shadow.exr",
                                            "depth.exr", "normal.exr", "insert.json"}));
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "new/one"))
    found.push_back(entry.path().filename().string());
  std::ranges::sort(found);
  std::ranges::sort(told);
  EXPECT_EQ(found, told);
  for (const auto& file : files) {
    if (file.extension() == ".json") continue;
    const io::Photo layer = io::load_photo(file);
    EXPECT_EQ(layer.linear.width(), 96) << file;
    EXPECT_EQ(layer.linear.height(), 72) << file;
  }
  // Outside the box: no object, an unshadowed photo.
  ASSERT_GT(drawn.done.box.top, 0);
  EXPECT_EQ(io::read_linear_picture(folder / "new/one/shadow.exr")(0, 0, 0), 1);
  EXPECT_EQ(io::read_linear_picture(folder / "new/one/depth.exr")(0, 0, 0), 0);
  EXPECT_NEAR(io::load_photo(folder / "new/one/composite.png").linear(0, 0, 0), 0.4F, 0.004F);  // half of 1/255 encoded
}

TEST(InsertionFiles, TheLinearCompositeIsNotClipped) {
  Drawn drawn;
  drawn.done.picture(3, 4, 1) = 20;  // a highlight
  const TempFolder folder;
  write_insertion(folder.path(), drawn.done, drawn.scene, "photo.jpg", "ball");
  const Image linear = io::read_linear_picture(folder / "composite.exr");
  ASSERT_TRUE(linear.same_size(drawn.done.picture));
  for (std::size_t i = 0; i < linear.values().size(); ++i) {
    const float value = drawn.done.picture.data()[i];
    ASSERT_NEAR(linear.data()[i], value, 1e-3F * value + 1e-6F);  // half floats have 11 bits
  }
}

TEST(InsertionFiles, TheObjectHasStraightAlpha) {
  Drawn drawn;
  const TempFolder folder;
  write_insertion(folder.path(), drawn.done, drawn.scene, "photo.jpg", "ball");
  const io::Photo straight = io::load_photo(folder / "object.png");
  int edge = 0;
  for (int y = 0; y < drawn.done.box.height(); ++y) {
    for (int x = 0; x < drawn.done.box.width(); ++x) {
      const float alpha = drawn.done.layers.object(x, y, 3);
      const int photo_x = drawn.done.box.left + x;
      const int photo_y = drawn.done.box.top + y;
      EXPECT_EQ((straight.clipped(photo_x, photo_y) & io::kTransparent) != 0, std::lround(255 * alpha) < 255)
          << x << ' ' << y;
      if (!(alpha > 0)) continue;
      edge += alpha < 1 ? 1 : 0;
      for (int c = 0; c < 3; ++c) {
        const float expected = std::min(1.0F, drawn.done.layers.object(x, y, c) / alpha);
        ASSERT_NEAR(straight.linear(photo_x, photo_y, c), expected, 0.005F)
            << x << ' ' << y;  // half of 1/255 encoded, 2.3 times that at white
      }
    }
  }
  EXPECT_GT(edge, 10);  // a ball of 24 px has an outline
}

TEST(InsertionFiles, AFolderThatCannotBeMadeLeavesNothing) {
  const Drawn drawn;
  const TempFolder folder;
  io::write_picture(folder / "taken.png", ByteImage(2, 2, 3));
  for (const char* name : {"taken.png", "taken.png/below"}) {  // root may write anywhere, but not below a file
    expect_error(ExitCode::kOutput, {"taken.png"},
                 [&] { write_insertion(folder / name, drawn.done, drawn.scene, "photo.jpg", "ball"); });
  }
  EXPECT_EQ(io::load_photo(folder / "taken.png").linear.width(), 2);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);

  // A target that is taken by a folder: what was written before is whole, and no temporary file stays.
  std::filesystem::create_directories(folder / "half/object.png");
  expect_error(ExitCode::kOutput, {"object.png"},
               [&] { write_insertion(folder / "half", drawn.done, drawn.scene, "photo.jpg", "ball"); });
  EXPECT_EQ(io::load_photo(folder / "half/composite.png").linear.width(), 96);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "half"), {}), 3);  // the composites, the folder
}

}  // namespace
}  // namespace faceprobe::pipeline
