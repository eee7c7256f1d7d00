#pragma once
// What the net tests share: a folder of their own, small networks and pictures.

#include "faceprobe/core/image.h"
#include "net/torch/unet.h"
#include "support/expect_error.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <torch/torch.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::net::testing {

using faceprobe::testing::expect_error;
using faceprobe::testing::TempFolder;

// The architecture in small.
UNetOptions small_options();
// Files of untrained networks, from a fixed seed.
void write_unet(const std::filesystem::path& path, const UNetOptions& options, bool half = false);
void write_mscr(const std::filesystem::path& path);
std::map<std::string, std::string> unet_metadata(const UNetOptions& options);

// Random light between `low` and `high`.
Image random_picture(int width, int height, float low, float high);

}  // namespace faceprobe::net::testing
