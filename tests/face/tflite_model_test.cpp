#include "face/tflite_model.h"

#include "face/fixtures.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace faceprobe::face {
namespace {

const std::vector<int> kShape = {1, 192, 192, 3};

void expect_model_error(const std::filesystem::path& path, const std::vector<int>& shape, const std::string& part) {
  try {
    TfliteModel model(path, shape);
    FAIL() << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::kModel);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

TEST(TfliteModel, RunsAndRepeatsItself) {
  TfliteModel model(io::data_file("face_landmark.tflite"), kShape);
  ASSERT_EQ(model.input().size(), 192U * 192 * 3);
  std::ranges::fill(model.input(), 0.5F);
  model.run();
  const std::vector<float> first(model.output(1404).begin(), model.output(1404).end());
  std::ranges::fill(model.input(), 0.0F);
  model.run();
  EXPECT_FALSE(std::ranges::equal(first, model.output(1404)));
  std::ranges::fill(model.input(), 0.5F);
  model.run();
  EXPECT_TRUE(std::ranges::equal(first, model.output(1404)));
  EXPECT_THROW(model.output(77), Error);
}

TEST(TfliteModel, RefusesWhatIsNoModelOrAnotherOne) {
  expect_model_error("no/such/file.tflite", kShape, "cannot be read");
  expect_model_error(TemporaryFile("").path(), kShape, "cannot be read");
  expect_model_error(TemporaryFile("just some text that is no network").path(), kShape, "not a TensorFlow Lite network");
  expect_model_error(io::data_file("face_landmark.tflite"), {1, 128, 128, 3}, "1x192x192x3");
}

}  // namespace
}  // namespace faceprobe::face
