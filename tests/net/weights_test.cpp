#include "net/torch/weights.h"

#include "faceprobe/io/tensor_file.h"
#include "faceprobe/net/model_file.h"
#include "net/fixtures.h"
#include "net/torch/mscr.h"

#include <fstream>

namespace faceprobe::net {
namespace {

using testing::expect_error;

class Weights : public ::testing::Test {
 protected:
  std::filesystem::path path() const { return folder_ / "w.safetensors"; }
  testing::TempFolder folder_;
};

UNet unet(std::uint64_t seed) {
  torch::manual_seed(seed);
  return UNet(testing::small_options());
}

// Largest difference over all tensors, in units of the larger of the value and `floor`.
double difference(const torch::nn::Module& a, const torch::nn::Module& b, double floor) {
  double worst = 0;
  const auto others = b.named_parameters();
  for (const auto& item : a.named_parameters()) {
    const torch::Tensor off = (item.value() - others[item.key()]).abs() / item.value().abs().clamp_min(floor);
    worst = std::max(worst, off.max().item<double>());
  }
  return worst;
}

TEST_F(Weights, F32ComesBackExactly) {
  UNet saved = unet(1), loaded = unet(2);
  ASSERT_GT(difference(*saved, *loaded, 1), 0.01);
  save_weights(*saved, path(), {}, false);
  load_weights(*loaded, path());
  EXPECT_EQ(difference(*saved, *loaded, 1e-30), 0);
}

TEST_F(Weights, F16ComesBackToHalfPrecision) {
  UNet saved = unet(1), loaded = unet(2);
  save_weights(*saved, path(), {}, true);
  load_weights(*loaded, path());
  const double off = difference(*saved, *loaded, 0x1p-14);
  EXPECT_LE(off, 0x1p-11);
  EXPECT_GT(off, 0);
}

TEST_F(Weights, BuffersAreKept) {
  Mscr saved(MscrOptions{}), loaded(MscrOptions{});
  const torch::NoGradGuard no_grad;
  loaded->buffers()[0].zero_();
  save_weights(*saved, path(), {}, true);
  load_weights(*loaded, path());
  EXPECT_TRUE(torch::equal(loaded->buffers()[0], bilinear_filter()));  // its values are halves already
}

// A file like the module's but for one change.
template <class Change>
void write_changed(const torch::nn::Module& module, const std::filesystem::path& path, const Change& change) {
  io::TensorFileBuilder builder;
  for (const auto& item : module.named_parameters()) {
    std::string name = item.key();
    std::vector<std::int64_t> shape = item.value().sizes().vec();
    if (change(name, shape)) builder.add<float>(name, shape);
  }
  builder.write(path);
}

TEST_F(Weights, AMissingTensorIsNamed) {
  UNet net = unet(1);
  write_changed(*net, path(), [](const std::string& name, const auto&) { return name != "head.bias"; });
  expect_error(ExitCode::kModel, {"'head.bias'", "[16]"}, [&] { load_weights(*net, path()); });
}

TEST_F(Weights, AMisshapenTensorIsNamedWithBothShapes) {
  UNet net = unet(1);
  write_changed(*net, path(), [](const std::string& name, auto& shape) {
    if (name == "head.weight") shape = {16, 3, 3, 8};
    return true;
  });
  expect_error(ExitCode::kModel, {"'head.weight'", "[16, 3, 3, 8]", "[16, 8, 3, 3]"},
               [&] { load_weights(*net, path()); });
}

TEST_F(Weights, AnExtraTensorIsNamed) {
  UNet net = unet(1);
  io::TensorFileBuilder builder;
  for (const auto& item : net->named_parameters()) builder.add<float>(item.key(), item.value().sizes().vec());
  builder.add<float>("momentum", {2, 3});
  builder.write(path());
  expect_error(ExitCode::kModel, {"'momentum'", "[2, 3]"}, [&] { load_weights(*net, path()); });
}

TEST_F(Weights, ARefusedFileChangesNothing) {
  UNet net = unet(1), same = unet(1);
  write_changed(*net, path(), [](const std::string& name, const auto&) { return name != "head.bias"; });
  EXPECT_THROW(load_weights(*net, path()), Error);
  EXPECT_EQ(difference(*net, *same, 1), 0);
}

TEST_F(Weights, FilesThatAreNoneAreRefused) {
  UNet net = unet(1);
  expect_error(ExitCode::kModel, {"w.safetensors"}, [&] { load_weights(*net, path()); });
  std::ofstream(path()) << "not weights at all";
  expect_error(ExitCode::kModel, {"w.safetensors"}, [&] { load_weights(*net, path()); });
}

TEST_F(Weights, WeightsThatAreNotNumbersAreNotWritten) {
  UNet net = unet(1);
  const torch::NoGradGuard no_grad;
  net->named_parameters()["head.bias"][3] = std::numeric_limits<float>::quiet_NaN();
  expect_error(ExitCode::kOutput, {"'head.bias'"}, [&] { save_weights(*net, path(), {}, false); });
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(Weights, AFileSaysWhatItIs) {
  std::int64_t count = 0;
  for (const torch::Tensor& parameter : unet(1)->parameters()) count += parameter.numel();
  auto metadata = testing::unet_metadata(testing::small_options());
  metadata["trained_on"] = "nothing";
  save_weights(*unet(1), path(), metadata, true);
  const ModelInfo info = read_model_info(path());
  EXPECT_EQ(info.architecture, "unet");
  EXPECT_EQ(unet_options_from_json(info.options_json), testing::small_options());
  EXPECT_EQ(info.parameter_count, count);
  EXPECT_EQ(info.sha256.size(), 64U);
  EXPECT_EQ(info.metadata.at("trained_on"), "nothing");
}

TEST_F(Weights, AFileThatDoesNotSayWhatItIsIsRefused) {
  save_weights(*unet(1), path(), {{kOptionsKey, "{}"}}, true);
  expect_error(ExitCode::kModel, {"w.safetensors", "\"architecture\""}, [&] { read_model_info(path()); });
  save_weights(*unet(1), path(), {{kArchitectureKey, "unet"}}, true);
  expect_error(ExitCode::kModel, {"w.safetensors", "\"options\""}, [&] { read_model_info(path()); });
}

}  // namespace
}  // namespace faceprobe::net
