#include "faceprobe/net/device.h"

#include "net/fixtures.h"
#include "net/torch/torch_device.h"

namespace faceprobe::net {
namespace {

using testing::expect_error;

TEST(Device, NamesAreRead) {
  EXPECT_EQ(device_from_name("cpu"), Device{});
  EXPECT_EQ(device_from_name("auto").cuda, torch::cuda::is_available());
  EXPECT_EQ(device_name({}), "cpu");
  EXPECT_EQ(device_name({.cuda = true, .index = 3}), "cuda:3");
}

TEST(Device, BadNamesAreRefused) {
  for (const char* name : {"", "gpu", "CPU", "cuda:", "cuda:x", "cuda:-1", "cuda:0x", "cuda:99999999999", "cuda0"}) {
    expect_error(ExitCode::kUsage, {'"' + std::string(name) + '"', "cuda:N"}, [&] { device_from_name(name); });
  }
}

TEST(Device, AnAbsentCardIsNotReplacedByTheProcessor) {
  expect_error(ExitCode::kDevice, {"cuda:63", "cpu"}, [] { device_from_name("cuda:63"); });
  if (torch::cuda::is_available()) {
    EXPECT_EQ(device_from_name("cuda"), (Device{.cuda = true, .index = 0}));
  } else {
    expect_error(ExitCode::kDevice, {"cuda:0"}, [] { device_from_name("cuda"); });
  }
}

TEST(Device, BecomesLibtorchs) {
  EXPECT_EQ(torch_device({}), torch::Device(torch::kCPU));
  EXPECT_EQ(torch_device({.cuda = true, .index = 2}), torch::Device(torch::kCUDA, 2));
}

}  // namespace
}  // namespace faceprobe::net
