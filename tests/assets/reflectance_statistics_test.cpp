#include "faceprobe/assets/reflectance_statistics.h"

#include "file_fixtures.h"

#include <cmath>

namespace faceprobe::assets {
namespace {

using testing::expect_error;
using testing::MatVersion;
using testing::TempFolder;

using Variables = std::map<std::string, Eigen::MatrixXd>;

// Two subjects of types 2 and 5; samples of the forehead (2) and the nose (5).
Variables measured() {
  Variables v;
  v["ts"].resize(5, 2);
  v["ts"] << 0.25, 0.125, 0.5, 0.25, 0.75, 0.375, 0.25, 0.5, std::nan(""), 0.5;
  v["ts_region"] = (Eigen::MatrixXd(5, 1) << 2, 2, 2, 5, 5).finished();
  v["ts_subjec"] = (Eigen::MatrixXd(5, 1) << 1, 1, 2, 2, 2).finished();
  v["subj_skintype"] = (Eigen::MatrixXd(1, 2) << 2, 5).finished();
  return v;
}

TEST(ReflectanceStatistics, AreMeansAndDeviationsOfTheFilesOwnNumbers) {
  const TempFolder folder;
  for (const MatVersion version : {MatVersion::k5, MatVersion::k73}) {
    testing::write_mat(folder / "ts_data.mat", measured(), version);
    const ReflectanceStatistics statistics = load_reflectance_statistics(folder / "ts_data.mat");
    const RegionReflectance* forehead = statistics.of(Region::kForehead);
    ASSERT_NE(forehead, nullptr);
    EXPECT_EQ(forehead->count, 3);
    EXPECT_DOUBLE_EQ(forehead->mean_roughness, 0.5);
    EXPECT_DOUBLE_EQ(forehead->roughness_deviation, 0.25);  // of .25, .5, .75, with n - 1
    EXPECT_DOUBLE_EQ(forehead->mean_specular_albedo, 0.25);
    EXPECT_DOUBLE_EQ(forehead->specular_albedo_deviation, 0.125);
    EXPECT_EQ(statistics.of(Region::kNose)->count, 1);  // one of the two is not a number
    EXPECT_EQ(statistics.of(Region::kNose)->roughness_deviation, 0);
    EXPECT_EQ(statistics.skipped, 1);
    EXPECT_EQ(statistics.of(Region::kChin), nullptr);
    ASSERT_EQ(statistics.by_skin_type.size(), 2U);
    EXPECT_DOUBLE_EQ(statistics.by_skin_type.at(2)[1].mean_roughness, 0.375);
    EXPECT_DOUBLE_EQ(statistics.by_skin_type.at(5)[1].mean_roughness, 0.75);
  }
}

TEST(ReflectanceStatistics, ReachTheSkinsThatAreDrawn) {
  const TempFolder folder;
  testing::write_mat(folder / "ts_data.mat", measured(), MatVersion::k5);
  const synth::SkinStatistics statistics = skin_statistics(load_reflectance_statistics(folder / "ts_data.mat"));
  const auto nose = static_cast<std::size_t>(Region::kNose) - 1;
  const auto chin = static_cast<std::size_t>(Region::kChin) - 1;
  EXPECT_TRUE(statistics.regions[nose].measured);
  EXPECT_FALSE(statistics.regions[chin].measured);
  Random with({1, 2});
  Random without({1, 2});
  const synth::SkinSettings skin = synth::draw_skin(0, with, &statistics);
  const synth::SkinSettings estimate = synth::draw_skin(0, without);
  // One sample has no spread, so that the nose is exactly as measured; a region without samples stays as it was.
  EXPECT_FLOAT_EQ(skin.roughness[nose], 0.25F);
  EXPECT_FLOAT_EQ(skin.specular_albedo[nose], 0.5F);
  EXPECT_EQ(skin.roughness[chin], estimate.roughness[chin]);
  EXPECT_EQ(skin.specular_albedo[chin], estimate.specular_albedo[chin]);
}

TEST(ReflectanceStatistics, RefuseWhatDoesNotFit) {
  const TempFolder folder;
  const auto refused = [&](const std::function<void(Variables&)>& change, const std::vector<std::string>& words) {
    Variables v = measured();
    change(v);
    testing::write_mat(folder / "bad.mat", v, MatVersion::k5);
    expect_error(ExitCode::kInput, words, [&] { load_reflectance_statistics(folder / "bad.mat"); });
  };
  refused([](Variables& v) { v.erase("ts_region"); }, {"bad.mat", "'ts_region' is missing"});
  refused([](Variables& v) { v["ts"].conservativeResize(5, 1); }, {"'ts' is 5 x 1", "any x 2"});
  refused([](Variables& v) { v["ts_subjec"].conservativeResize(4, 1); }, {"'ts_subjec' is 4 x 1", "5 numbers"});
  refused([](Variables& v) { v["ts_region"](0, 0) = 11; }, {"'ts_region' holds 11", "1 to 10"});
  refused([](Variables& v) { v["ts_subjec"](0, 0) = 3; }, {"'ts_subjec' holds 3", "1 to 2"});
  refused([](Variables& v) { v["subj_skintype"](0, 0) = 0; }, {"'subj_skintype' holds 0", "1 to 6"});
}

}  // namespace
}  // namespace faceprobe::assets
