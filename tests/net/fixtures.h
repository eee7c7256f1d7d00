#pragma once
// What the net tests share: a folder of their own, small networks and pictures.

#include "faceprobe/core/error.h"
#include "faceprobe/core/image.h"
#include "net/torch/unet.h"

#include <gtest/gtest.h>
#include <torch/torch.h>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace faceprobe::net::testing {

// A folder of its own, removed with what is in it.
class TempFolder {
 public:
  TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// Runs `body`; expects faceprobe::Error with this code whose sentence contains all of `parts`.
template <class Body>
void expect_error(ExitCode code, const std::vector<std::string>& parts, const Body& body) {
  try {
    body();
    ADD_FAILURE() << "no Error was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    for (const std::string& part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << "'" << part << "' is not in: " << error.what();
    }
  }
}

// The architecture in small.
UNetOptions small_options();
// Files of untrained networks, from a fixed seed.
void write_unet(const std::filesystem::path& path, const UNetOptions& options, bool half = false);
void write_mscr(const std::filesystem::path& path);
std::map<std::string, std::string> unet_metadata(const UNetOptions& options);

// Random light between `low` and `high`.
Image random_picture(int width, int height, float low, float high);

}  // namespace faceprobe::net::testing
