#include "faceprobe/pipeline/traced_photos.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/lighting/face_features.h"
#include "faceprobe/pipeline/found_meshes.h"
#include "faceprobe/synth/shard.h"
#include "faceprobe/synth/traced.h"
#include "pipeline/portrait.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace faceprobe::pipeline {
namespace {

// A data set of one photo of a real person, whose light is said to come from the left.
void write_portrait(const std::filesystem::path& data) {
  const ByteImage portrait = encode_srgb(testing::portrait().linear);
  const int size = std::max(portrait.width(), portrait.height());
  ByteImage photo(size, size, 3);
  for (int y = 0; y < portrait.height(); ++y)
    std::copy_n(portrait.pixel(0, y), portrait.row(y).size(), photo.pixel(0, y));
  synth::ViewSamples view;
  view.view.normal = Image(size, size, 3);
  view.view.depth_m = Image(size, size, 1);
  view.view.region = view.view.owner = ByteImage(size, size, 1);
  view.view.focal_px = 1.5F * static_cast<float>(size);
  view.view.centre_px = {0.5F * static_cast<float>(size), 0.5F * static_cast<float>(size)};
  view.view.faces.resize(1);
  synth::Sample sample;
  sample.photo = photo;
  sample.clip = ByteImage(size, size, 1);
  sample.highlight = sample.albedo = sample.shading = Image(size, size, 3);
  sample.diffuse = decode_srgb(photo);
  sample.environment = EnvMap(16, 8);
  for (int c = 0; c < 3; ++c) sample.environment.radiance()(12, 4, c) = 5;
  sample.settings_json = "{}";
  view.samples.push_back(std::move(sample));
  const synth::ShardWriter writer(data, {.size_px = size, .environment_height = 8, .recipe = "{}"});
  writer.write(0, std::vector<synth::ViewSamples>{view});
  writer.finish(1, "");
}

TEST(TracedPhotos, AreWhatAnEstimateReadsAndTheTrueLight) {
  const faceprobe::testing::TempFolder folder;
  const std::filesystem::path data = folder / "faces";
  write_portrait(data);
  EXPECT_THROW(trace_photos(data, {}), Error);  // no meshes yet
  find_meshes(data, face::FaceFinder());
  const TraceCount count = trace_photos(data, {});
  EXPECT_EQ(count.photos, 1);
  EXPECT_EQ(count.traced, 1);
  const std::vector<synth::TracedPhoto> traced = synth::read_traced(data);
  ASSERT_EQ(traced.size(), 1U);
  ASSERT_EQ(traced[0].features.size(), lighting::kFaceFeatures);
  EXPECT_TRUE(traced[0].features.allFinite());
  Eigen::Index brightest = 0;
  traced[0].light.col(0).maxCoeff(&brightest);
  // Column 12 of 16 is three quarters of the way to the right: -x.
  EXPECT_LT(SphereGrid(lighting::kFeatureNside).direction(static_cast<int>(brightest)).x(), -0.8F);

  // The whole way through the estimate, whose crop is the finder's own and larger, says nearly the same.
  Estimator estimator;
  const Estimate whole = estimator.estimate(testing::portrait());
  const Eigen::VectorXf features = lighting::face_features(whole.largest_face().observations);
  const auto likeness = [&](const Eigen::VectorXf& other) {
    return features.dot(other) / (features.norm() * other.norm());
  };
  EXPECT_GT(likeness(traced[0].features), 0.95F);  // another crop and focal length
  EXPECT_GT(likeness(traced[0].features), likeness(lighting::mirrored_features(traced[0].features)));

  EXPECT_EQ(trace_photos(data, {}).photos, 0);  // nothing left to do
}

}  // namespace
}  // namespace faceprobe::pipeline
