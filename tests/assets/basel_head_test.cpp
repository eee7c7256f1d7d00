#include "faceprobe/assets/heads.h"
#include "faceprobe/core/color.h"
#include "file_fixtures.h"

#include <cmath>

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::H5Data;
using testing::MatVersion;
using testing::TempFolder;

// A tent of five points in metres, its ridge in front; facing +z when its triangles run counter-clockwise.
const std::array<std::array<double, 3>, 5> kPoints = {
    {{-0.06, -0.1, 0}, {0.06, -0.1, 0}, {0.06, 0.1, 0}, {-0.06, 0.1, 0}, {0, 0, 0.08}}};
const std::array<std::array<int, 3>, 4> kTriangles = {{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};

using Variables = std::map<std::string, Eigen::MatrixXd>;

Variables basel_2009() {
  Variables v;
  v["shapeMU"].resize(15, 1);
  for (int i = 0; i < 15; ++i)
    v["shapeMU"](i, 0) = kPoints[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)] * 1e6;
  v["shapePC"] = Eigen::MatrixXd::Zero(15, 2);
  v["shapePC"](14, 0) = 1;  // z of the ridge
  v["shapePC"](1, 1) = 1;   // y of the first point
  v["shapeEV"] = (Eigen::MatrixXd(2, 1) << 2000, 3000).finished();
  v["texMU"] = Eigen::MatrixXd::Constant(15, 1, 128);
  v["texPC"] = Eigen::MatrixXd::Zero(15, 1);
  v["texPC"](0, 0) = 1;  // red of the first point
  v["texEV"] = Eigen::MatrixXd::Constant(1, 1, 2.55);
  v["tl"].resize(4, 3);
  for (int t = 0; t < 4; ++t) {
    for (int c = 0; c < 3; ++c)
      v["tl"](t, c) = kTriangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(c)] + 1;
  }
  return v;
}

class Basel2009 : public ::testing::TestWithParam<MatVersion> {};

TEST_P(Basel2009, BecomesAHeadInMetresWithLinearAlbedo) {
  const TempFolder folder;
  testing::write_mat(folder / "01_MorphableModel.mat", basel_2009(), GetParam());
  const synth::HeadModel model = load_basel_head(folder / "01_MorphableModel.mat");
  EXPECT_EQ(model.validate(), "");
  ASSERT_EQ(model.neutral.rows(), 5);
  EXPECT_NEAR(model.neutral(1, 0) - model.neutral(0, 0), 0.12F, 1e-6F);  // float rounding
  ASSERT_EQ(model.identity.size(), 2U);
  EXPECT_FLOAT_EQ(model.identity[0](4, 2), 0.002F);  // shapeEV is a deviation, not a variance
  EXPECT_FLOAT_EQ(model.identity[1](0, 1), 0.003F);
  EXPECT_FLOAT_EQ(model.identity[0].norm(), 0.002F);
  EXPECT_EQ(model.triangles.row(0), Eigen::RowVector3i(0, 1, 4));
  EXPECT_FLOAT_EQ(model.vertex_albedo(3, 1), linear_from_srgb(128.0F / 255));
  // A hundredth of the encoded range, through the curve: its slope is right to second order.
  const float change = linear_from_srgb(128.0F / 255 + 0.005F) - linear_from_srgb(128.0F / 255 - 0.005F);
  EXPECT_NEAR(model.albedo_modes[0](0, 0), change, 1e-5F);
  EXPECT_EQ(model.albedo_modes[0].row(1).norm(), 0);
}
INSTANTIATE_TEST_SUITE_P(Versions, Basel2009, ::testing::Values(MatVersion::k5, MatVersion::k73));

TEST(Basel2009Files, TrianglesThatFaceInwardsAreTurned) {
  const TempFolder folder;
  Variables v = basel_2009();
  v["tl"].col(0).swap(v["tl"].col(1));
  testing::write_mat(folder / "a.mat", v, MatVersion::k5);
  EXPECT_EQ(load_basel_head(folder / "a.mat").triangles.row(0), Eigen::RowVector3i(1, 4, 0));
}

TEST(Basel2009Files, RefusesWhatDoesNotFit) {
  const TempFolder folder;
  const auto refused = [&](const std::function<void(Variables&)>& change, const std::vector<std::string>& words) {
    Variables v = basel_2009();
    change(v);
    testing::write_mat(folder / "bad.mat", v, MatVersion::k5);
    expect_error(ExitCode::kInput, words, [&] { load_basel_head(folder / "bad.mat"); });
  };
  refused([](Variables& v) { v.erase("shapeEV"); }, {"bad.mat", "'shapeEV' is missing"});
  refused([](Variables& v) { v.erase("tl"); }, {"'tl' is missing"});
  refused([](Variables& v) { v["shapeMU"].conservativeResize(14, 1); }, {"'shapeMU'", "14"});
  refused([](Variables& v) { v["shapePC"].conservativeResize(12, 2); }, {"'shapePC' is 12 x 2", "15 x any"});
  refused([](Variables& v) { v["shapeEV"] = Eigen::VectorXd::Ones(3); }, {"'shapeEV' is 3 x 1", "2 numbers"});
  refused([](Variables& v) { v["texMU"].conservativeResize(9, 1); }, {"'texMU' is 9 x 1"});
  refused([](Variables& v) { v["tl"](2, 2) = 6; }, {"'tl'", "outside 1 .. 5"});
  refused([](Variables& v) { v["tl"](2, 2) = 0; }, {"'tl'", "outside 1 .. 5"});
  refused([](Variables& v) { v["shapeMU"](3, 0) = std::nan(""); }, {"bad.mat", "not finite"});
  testing::write_text(folder / "text.mat", "no model");
  expect_error(ExitCode::kInput, {"text.mat", "version 5 and 7.3"}, [&] { load_basel_head(folder / "text.mat"); });
  testing::write_text(folder / "model.pca", "no model");
  expect_error(ExitCode::kInput, {"model.pca", "2009", "2017, 2019"}, [&] { load_basel_head(folder / "model.pca"); });
}

using Datasets = std::map<std::string, H5Data>;

Datasets basel_h5() {
  Datasets d;
  H5Data mean{{15}, {}, ""};
  for (const auto& point : kPoints) {
    for (const double value : point) mean.numbers.push_back(static_cast<float>(value * 1000));
  }
  d["shape/model/mean"] = mean;
  H5Data basis{{15, 2}, std::vector<float>(30), ""};
  basis.numbers[14 * 2 + 0] = 1;
  basis.numbers[1 * 2 + 1] = 1;
  d["shape/model/pcaBasis"] = basis;
  d["shape/model/pcaVariance"] = {{2}, {4, 9}, ""};
  H5Data cells{{3, 4}, {}, ""};
  for (std::size_t c = 0; c < 3; ++c) {
    for (const auto& triangle : kTriangles) cells.numbers.push_back(static_cast<float>(triangle[c]));
  }
  d["shape/representer/cells"] = cells;
  d["color/model/mean"] = {{15}, std::vector<float>(15, 0.5F), ""};
  d["color/model/pcaBasis"] = {{15, 1}, std::vector<float>(15, 0.0F), ""};
  d["color/model/pcaBasis"].numbers[0] = 1;
  d["color/model/pcaVariance"] = {{1}, {0.0001F}, ""};
  d["expression/model/mean"] = {{15}, std::vector<float>(15, 1.0F), ""};  // a millimetre along each axis
  d["expression/model/pcaBasis"] = {{15, 1}, std::vector<float>(15, 0.0F), ""};
  d["expression/model/pcaBasis"].numbers[13] = 1;
  d["expression/model/pcaVariance"] = {{1}, {25}, ""};
  return d;
}

TEST(BaselH5, BecomesAHeadInMetresWithExpressions) {
  const TempFolder folder;
  testing::write_h5(folder / "model2017-1_face12_nomouth.h5", basel_h5());
  const synth::HeadModel model = load_basel_head(folder / "model2017-1_face12_nomouth.h5");
  EXPECT_EQ(model.validate(), "");
  EXPECT_EQ(model.name, "model2017-1_face12_nomouth");
  ASSERT_EQ(model.neutral.rows(), 5);
  EXPECT_NEAR(model.neutral(1, 0) - model.neutral(0, 0), 0.12F, 1e-6F);
  ASSERT_EQ(model.identity.size(), 2U);
  EXPECT_FLOAT_EQ(model.identity[0](4, 2), 0.002F);  // root of the variance 4, in millimetres
  EXPECT_FLOAT_EQ(model.identity[1](0, 1), 0.003F);
  ASSERT_EQ(model.expression.size(), 1U);
  EXPECT_FLOAT_EQ(model.expression[0](4, 1), 0.005F);
  EXPECT_TRUE(model.expression_names.empty());
  EXPECT_EQ(model.triangles.row(1), Eigen::RowVector3i(1, 2, 4));
  EXPECT_FLOAT_EQ(model.vertex_albedo(0, 0), linear_from_srgb(0.5F));
  EXPECT_TRUE(model.landmarks.empty());
}

TEST(BaselH5, TakesNumberedLandmarks) {
  const TempFolder folder;
  Datasets d = basel_h5();
  std::string json = "[";
  for (int i = 0; i < 68; ++i) {
    const std::size_t at = i >= 36 && i < 48 ? 4 : 2;
    json += std::string(i == 0 ? "" : ",") + "{\"id\":\"" + std::to_string(i) + "\",\"coordinates\":[" +
            std::to_string(kPoints[at][0] * 1000) + "," + std::to_string(kPoints[at][1] * 1000) + "," +
            std::to_string(kPoints[at][2] * 1000) + "]}";
  }
  d["metadata/landmarks/json"].text = json + "]";
  testing::write_h5(folder / "a.h5", d);
  const synth::HeadModel model = load_basel_head(folder / "a.h5");
  ASSERT_EQ(model.landmarks.size(), 68U);
  EXPECT_EQ(model.landmarks[36], 4);
  EXPECT_EQ(model.landmarks[0], 2);
  EXPECT_LE(model.neutral.row(4).norm(), 1e-6F);

  d["metadata/landmarks/json"].text = R"([{"id":"center.nose.tip","coordinates":[0,0,80]}])";
  testing::write_h5(folder / "a.h5", d);
  EXPECT_TRUE(load_basel_head(folder / "a.h5").landmarks.empty());  // names that do not say which of the 68
  d["metadata/landmarks/json"].text = "[{";
  testing::write_h5(folder / "a.h5", d);
  expect_error(ExitCode::kInput, {"metadata/landmarks/json"}, [&] { load_basel_head(folder / "a.h5"); });
}

TEST(BaselH5, RefusesOtherLayouts) {
  const TempFolder folder;
  const auto refused = [&](const std::function<void(Datasets&)>& change, const std::vector<std::string>& words) {
    Datasets d = basel_h5();
    change(d);
    testing::write_h5(folder / "bad.h5", d);
    expect_error(ExitCode::kInput, words, [&] { load_basel_head(folder / "bad.h5"); });
  };
  refused(
      [](Datasets& d) {
        d = {{"model/vertices", {{3}, {1, 2, 3}, ""}}};
      },
      {"bad.h5", "shape/model/mean", "2017 or 2019"});
  refused([](Datasets& d) { d.erase("shape/model/pcaBasis"); }, {"'shape/model/pcaBasis' is missing"});
  refused([](Datasets& d) { d.erase("shape/representer/cells"); }, {"'shape/representer/cells' is missing"});
  refused([](Datasets& d) { d["shape/model/pcaVariance"] = {{3}, {1, 1, 1}, ""}; }, {"pcaBasis' is 15 x 2", "15 x 3"});
  refused([](Datasets& d) { d["shape/model/pcaVariance"] = {{2}, {4, -1}, ""}; }, {"not a variance"});
  refused(
      [](Datasets& d) {
        d["color/model/mean"] = {{12}, std::vector<float>(12), ""};
      },
      {"'color/model/mean' holds 12", "15"});
  refused([](Datasets& d) { d["shape/representer/cells"].numbers[5] = 5; }, {"outside 0 .. 4"});
  refused([](Datasets& d) { d["shape/representer/cells"].shape = {2, 6}; }, {"is 2 x 6", "3 x"});
  refused([](Datasets& d) { d["shape/model/mean"].numbers[3] = std::nanf(""); }, {"not finite"});
  testing::write_text(folder / "text.h5", "no model");
  expect_error(ExitCode::kInput, {"text.h5", "HDF5"}, [&] { load_basel_head(folder / "text.h5"); });
}

}  // namespace
}  // namespace faceprobe::assets
