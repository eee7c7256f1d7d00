#include "small_head.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace faceprobe::synth {
namespace {

struct Fault {
  const char* words;  // that the sentence must hold
  std::function<void(HeadModel&)> make;
};

TEST(HeadModelValidate, AcceptsAModelThatFits) { EXPECT_EQ(small_head().validate(), ""); }

TEST(HeadModelValidate, NamesWhatDoesNotFit) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Fault faults[] = {
      {"0 triangles", [](HeadModel& m) { m.triangles.resize(0, 3); }},
      {"a vertex is not finite", [nan](HeadModel& m) { m.neutral(3, 1) = nan; }},
      {"outside 0 .. 6", [](HeadModel& m) { m.triangles(1, 1) = 7; }},
      {"outside 0 .. 6", [](HeadModel& m) { m.triangles(1, 1) = -1; }},
      {"materials for 3", [](HeadModel& m) { m.triangle_material.pop_back(); }},
      {"other than skin, eye", [](HeadModel& m) { m.triangle_material[0] = Material::kHair; }},
      {"regions for 6", [](HeadModel& m) { m.vertex_region.pop_back(); }},
      {"a texture point is not finite", [nan](HeadModel& m) { m.uv(0, 0) = nan; }},
      {"outside 0 .. 4", [](HeadModel& m) { m.triangle_uv(0, 0) = 5; }},
      {"texture points for 3", [](HeadModel& m) { m.triangle_uv.conservativeResize(3, 3); }},
      {"it has none", [](HeadModel& m) { m.uv.resize(0, 2); }},
      {"1 channels", [](HeadModel& m) { m.texture = ByteImage(4, 4, 1); }},
      {"identity mode 0 moves 8 of 7", [](HeadModel& m) { m.identity[0].resize(8, 3); }},
      {"identity mode 1 is not finite", [nan](HeadModel& m) { m.identity[1](0, 0) = nan; }},
      {"2 names", [](HeadModel& m) { m.expression_names.emplace_back("mouthSmile_L"); }},
      {"67 landmarks", [](HeadModel& m) { m.landmarks.assign(67, 0); }},
      {"a landmark is vertex 7", [](HeadModel& m) { m.landmarks.assign(68, 7); }},
      {"467 dense landmarks", [](HeadModel& m) { m.dense_landmarks.resize(467); }},
      {"lies on triangle 4",
       [](HeadModel& m) {
         m.dense_landmarks.assign(468, {4, Eigen::Vector3f(1, 0, 0)});
       }},
      {"do not sum to 1",
       [](HeadModel& m) {
         m.dense_landmarks.assign(468, {0, Eigen::Vector3f(1, 0, 0.1F)});
       }},
      {"albedo for 5", [](HeadModel& m) { m.vertex_albedo.setZero(5, 3); }},
      {"without a mean albedo", [](HeadModel& m) { m.albedo_modes.emplace_back(Eigen::MatrixX3f::Zero(7, 3)); }},
  };
  for (const Fault& fault : faults) {
    HeadModel model = small_head();
    fault.make(model);
    const std::string sentence = model.validate();
    EXPECT_NE(sentence.find(fault.words), std::string::npos) << fault.words << " <- " << sentence;
    EXPECT_NE(sentence.find("'pyramid'"), std::string::npos) << sentence;
  }
}

}  // namespace
}  // namespace faceprobe::synth
