#include "faceprobe/pipeline/report.h"

#include "faceprobe/core/resample.h"
#include "faceprobe/core/version.h"
#include "faceprobe/pipeline/outputs.h"
#include "faceprobe/pipeline/overview.h"
#include "pipeline/documented_fields.h"
#include "pipeline/portrait.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace faceprobe::pipeline {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::add_fields;
using testing::documented_fields;
using testing::Field;
using testing::portrait;
using testing::portrait_estimate;
using testing::twice_side_by_side;

std::set<std::string> files_under(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder).string());
  }
  return names;
}

// The list of include/faceprobe/pipeline/outputs.h for one face.
std::set<std::string> files_of_a_face(bool layers = true) {
  std::set<std::string> names = {"environment.exr", "environment.hdr",      "environment.png",
                                 "confidence.exr",  "environment_rest.exr", "light.usda",
                                 "light.gltf",      "blender.py",           "overview.png"};
  if (!layers) return names;
  names.insert("regions.png");
  for (const char* layer : {"highlight", "diffuse", "albedo", "shading", "normals"}) {
    names.insert(layer + std::string(".exr"));
    names.insert(layer + std::string(".png"));
  }
  return names;
}

TEST(Report, HoldsTheDocumentedFields) {
  const std::string text = report_json(portrait_estimate(), portrait(), EstimateOptions(), "portrait.jpg");
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  const json report = json::parse(text);
  EXPECT_EQ(report.at("schema"), "faceprobe-report/1");
  EXPECT_EQ(report.at("program").at("version"), std::string(kVersion));
  EXPECT_EQ(report.at("photo").at("source"), "portrait.jpg");
  EXPECT_EQ(report.at("photo").at("sha256").get<std::string>().size(), 64U);
  EXPECT_EQ(report.at("photo").at("width_px"), portrait().linear.width());
  EXPECT_GT(report.at("camera").at("focal_px").get<double>(), 1);
  EXPECT_EQ(report.at("options").at("separator"), EstimateOptions().separator_name());
  EXPECT_EQ(report.at("options").at("solver"), "transport");
  EXPECT_EQ(report.at("options").at("map_size_px"), json({256, 128}));
  EXPECT_EQ(report.at("largest_face"), 0);
  EXPECT_FALSE(report.contains("joint_light"));
  EXPECT_TRUE(report.at("warnings").is_array());
  ASSERT_EQ(report.at("faces").size(), 1U);
  const json& face = report.at("faces")[0];
  for (const char* side : {"x", "y", "width", "height"}) EXPECT_TRUE(face.at("box_px").at(side).is_number());
  EXPECT_EQ(face.at("position_m").size(), 3U);
  EXPECT_EQ(face.at("camera_from_face_rotation").size(), 3U);
  EXPECT_LT(std::abs(face.at("yaw_deg").get<double>()), 45);
  EXPECT_GT(face.at("patches").get<int>(), 30);
  const json& light = face.at("light");
  EXPECT_EQ(light.at("spherical_harmonics").at("rgb").size(), 9U);
  EXPECT_EQ(light.at("spherical_harmonics").at("quantity"), "radiance");
  const json& finer = light.at("spherical_harmonics_4").at("rgb");
  ASSERT_EQ(finer.size(), 25U);
  const json& nine = light.at("spherical_harmonics").at("rgb");
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(finer[i][1].get<double>(), nine[i][1].get<double>(), 1e-9) << i;
  // A face's picture is never explained to the last bit, and by any light better than by darkness, of which the residual is 1.
  for (const char* residual : {"highlight_residual", "shading_residual"}) {
    EXPECT_GT(light.at(residual).get<double>(), 0) << residual;
    EXPECT_LT(light.at(residual).get<double>(), 1) << residual;
  }
  double share = 0;
  for (const json& lamp : light.at("main_lights")) share += lamp.at("share_of_energy").get<double>();
  EXPECT_NEAR(light.at("light_to_ambient_ratio").get<double>(), share / (1 - share), 1e-9);
  EXPECT_TRUE(face.at("light_colour_uncertainty_deg").is_null()) << "the network states no error";
  for (const json& channel : face.at("skin_albedo_mean_rgb")) {
    EXPECT_GT(channel.get<double>(), 0);
    EXPECT_LT(channel.get<double>(), 1);
  }
  ASSERT_EQ(light.at("main_lights").size(), portrait_estimate().faces[0].lights.size());
  const json& strongest = light.at("main_lights").at(0);
  EXPECT_NEAR(strongest.at("direction")[0].get<double>(), portrait_estimate().faces[0].lights[0].direction.x(), 1e-12);
  for (const char* number : {"azimuth_deg", "elevation_deg", "irradiance", "peak_radiance", "solid_angle_sr",
                             "share_of_energy", "direction_uncertainty_deg", "irradiance_uncertainty"}) {
    EXPECT_TRUE(strongest.at(number).is_number()) << number;
  }
  // About what is measured of portraits (docs/results.md); the bounds are wide.
  EXPECT_GT(strongest.at("direction_uncertainty_deg").get<double>(), 2);
  EXPECT_LT(strongest.at("direction_uncertainty_deg").get<double>(), 40);
  EXPECT_TRUE(face.at("same_person").is_null());
  EXPECT_GT(report.at("timings").at("total_seconds").get<double>(), 0);
}

// Both ways: a field that is not documented, and a documented one that is not there.
TEST(Report, EveryFieldStandsInTheDocumentation) {
  Estimate estimate = portrait_estimate();
  estimate.joint = estimate.faces[0];  // as two faces have it
  estimate.faces[0].same_person = SamePerson{};
  const json report = json::parse(report_json(estimate, portrait(), EstimateOptions(), "portrait.jpg"));
  std::set<Field> written;
  add_fields(report, "report.json", written);
  const std::vector<JointPhoto> photos = {{"a.jpg", "12ab", 1}};
  add_fields(json::parse(joint_report_json(estimate.faces[0], photos, EstimateOptions())), "joint/report.json", written);
  ASSERT_GT(written.size(), 60U);
  const std::set<Field> documented = documented_fields("report.md");
  for (const auto& [object, name] : written)
    EXPECT_TRUE(documented.contains({object, name})) << object << '.' << name << " is not in docs/report.md";
  for (const auto& [object, name] : documented)
    EXPECT_TRUE(written.contains({object, name})) << object << '.' << name << " of docs/report.md is in no report";
}

json sources_of(const io::Photo& photo, const EstimateOptions& options) {
  const Estimate estimate = Estimator(options).estimate(photo);
  EXPECT_EQ(estimate.faces.size(), 1U);
  return json::parse(report_json(estimate, photo, options, "portrait.jpg")).at("faces")[0].at("sources");
}

// Not what the options ask for, which the report has too.
TEST(Report, SaysWhatAFaceWasReadBy) {
  const json all = {{"separator", "net"}, {"geometry", "net"}, {"shading", "net"}, {"prior", "net"}};
  const json none = {{"separator", "tan"}, {"geometry", "mesh"}, {"shading", "regions"}, {"prior", "smooth"}};
  EstimateOptions options;
  options.max_patches = 50;
  options.solve.nside = 4;
  options.solve.iterations = 1;
  EXPECT_EQ(sources_of(portrait(), options), all);
  // The middle of the face alone: of the network its normals are used.
  const Window middle{.left_px = 190, .top_px = 140, .width = 150, .height = 190};
  io::Photo cut = portrait();
  cut.linear = resampled(cut.linear, middle);
  cut.clipped = resampled(cut.clipped, middle);
  EXPECT_EQ(sources_of(cut, options),
            json({{"separator", "yang"}, {"geometry", "net"}, {"shading", "regions"}, {"prior", "smooth"}}));
  options.classical = highlight::Separator::kTan;
  EXPECT_EQ(sources_of(portrait(), options), none);
}

TEST(Report, AJointLightHasAReportOfItsOwn) {
  const LightResult& light = portrait_estimate().faces[0];
  const std::vector<JointPhoto> photos = {{"one.jpg", "12ab", 1}, {"two \xff.jpg", "34cd", 3}};
  const testing::TempFolder folder;
  const auto files = write_joint(folder.path() / "joint", light, photos, EstimateOptions());
  ASSERT_EQ(files.back(), folder.path() / "joint" / "report.json");
  EXPECT_EQ(files_under(folder.path()).size(), files.size());
  std::ifstream file(files.back());
  const json report = json::parse(file);
  EXPECT_EQ(report.at("schema"), "faceprobe-joint-report/1");
  ASSERT_EQ(report.at("photos").size(), 2U);
  EXPECT_EQ(report.at("photos")[0], json({{"source", "one.jpg"}, {"sha256", "12ab"}, {"faces", 1}}));
  EXPECT_EQ(report.at("photos")[1].at("source"), "two \xef\xbf\xbd.jpg");
  // The light of a joint report is told as a face's is.
  const json own = json::parse(report_json(portrait_estimate(), portrait(), EstimateOptions(), "one.jpg"));
  EXPECT_EQ(report.at("light"), own.at("faces")[0].at("light"));
  EXPECT_EQ(report.at("options"), own.at("options"));
}

TEST(Report, SourceNamesMayBeAnyBytes) {
  const std::string text =
      report_json(portrait_estimate(), portrait(), EstimateOptions(), "a \"quoted\"\n\xff name.jpg");
  EXPECT_EQ(json::parse(text).at("photo").at("source"),
            "a \"quoted\"\n\xef\xbf\xbd name.jpg");  // U+FFFD for what is not UTF-8
}

TEST(Outputs, OneFaceFillsTheFolderItself) {
  const testing::TempFolder folder;
  const fs::path target = folder.path() / "not" / "there yet";
  const auto written = write_outputs(target, portrait_estimate(), portrait(), EstimateOptions(), "portrait.jpg");
  std::set<std::string> wanted = files_of_a_face();
  wanted.insert("report.json");
  EXPECT_EQ(files_under(target), wanted);
  EXPECT_EQ(written.size(), wanted.size());
  for (const fs::path& path : written) EXPECT_TRUE(fs::is_regular_file(path)) << path;
  std::ifstream report(target / "report.json");
  EXPECT_EQ(json::parse(report).at("schema"), "faceprobe-report/1");
}

TEST(Outputs, SeveralFacesGetAFolderEach) {
  EstimateOptions options;
  options.solve.nside = 4;
  const io::Photo two = twice_side_by_side(portrait());
  const Estimate estimate = Estimator(options).estimate(two);
  ASSERT_EQ(estimate.faces.size(), 2U);
  const testing::TempFolder folder;
  OutputOptions output;
  output.layers = false;
  write_outputs(folder.path(), estimate, two, options, "two.jpg", output);
  std::set<std::string> wanted = {"report.json",           "joint/environment.exr", "joint/environment.hdr",
                                  "joint/environment.png", "joint/confidence.exr",  "joint/environment_rest.exr",
                                  "joint/light.usda",      "joint/light.gltf",      "joint/blender.py"};
  for (const std::string& name : files_of_a_face(false)) {
    for (const char* place : {"", "face_1/", "face_2/"}) wanted.insert(place + name);
  }
  EXPECT_EQ(files_under(folder.path()), wanted);
}

TEST(Outputs, ProvenanceNamesWhatMadeTheFile) {
  EstimateOptions options;
  options.classical = highlight::Separator::kYang;
  options.solve.solver = lighting::Solver::kPaper;
  const auto attributes = provenance(portrait(), options);
  EXPECT_EQ(attributes.at("faceprobe:version"), std::string(kVersion));
  EXPECT_EQ(attributes.at("faceprobe:separator"), "yang");
  EXPECT_EQ(attributes.at("faceprobe:solver"), "paper");
  EXPECT_EQ(attributes.at("faceprobe:input_sha256"), portrait().sha256);
}

TEST(Overview, ShowsThePhotoAndIsTheSameForAnyNumberOfThreads) {
  const ByteImage one = draw_overview(portrait_estimate(), portrait(), 0, 1);
  EXPECT_EQ(one.width(), 1600);
  EXPECT_EQ(one.channels(), 3);
  std::set<std::uint32_t> colours;
  for (int y = 0; y < one.height(); ++y) {
    for (int x = 0; x < one.width(); ++x) {
      const std::uint8_t* p = one.pixel(x, y);
      colours.insert(static_cast<std::uint32_t>(p[0] << 16 | p[1] << 8 | p[2]));
    }
  }
  EXPECT_GT(colours.size(), 2000U) << "a photo, a map and three balls have more colours than captions on paper";
  EXPECT_EQ(one, draw_overview(portrait_estimate(), portrait(), 0, 3));
  EXPECT_THROW(draw_overview(portrait_estimate(), portrait(), 1), std::out_of_range);
}

}  // namespace
}  // namespace faceprobe::pipeline
