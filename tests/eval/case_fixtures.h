#pragma once
// Small cases, and files that are not in order.

#include "faceprobe/eval/case_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace faceprobe::eval::fixtures {

inline constexpr int kCaseWidth = 16;
inline constexpr int kCaseHeight = 12;

// A picture of one colour.
inline Image plain(int width, int height, const std::array<float, 3>& colour) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.values().size(); ++i) image.data()[i] = colour[i % 3];
  return image;
}

// With everything that a case can have. A lamp stands at the right.
inline Case whole_case() {
  Case one;
  one.photo = ByteImage(kCaseWidth, kCaseHeight, 3, 128);
  one.highlight = Image(kCaseWidth, kCaseHeight, 3);
  for (std::size_t i = 0; i < one.highlight.values().size(); ++i)
    one.highlight.data()[i] = 0.001F * static_cast<float>(i % 97);
  one.diffuse = plain(kCaseWidth, kCaseHeight, {0.2F, 0.15F, 0.1F});
  one.normal_cam = plain(kCaseWidth, kCaseHeight, {-0.6F, 0.0F, 0.8F});
  one.normal_cam(0, 0, 0) = one.normal_cam(0, 0, 2) = 0;
  one.mask = ByteImage(kCaseWidth, kCaseHeight, 1, 255);
  one.mask(3, 4) = 0;
  one.light = EnvMap(32, 16);
  for (float& value : one.light->radiance().values()) value = 0.1F;
  for (int c = 0; c < 3; ++c) one.light->radiance()(8, 8, c) = 40;
  one.pose = CasePose{{.focal_px = 800.5, .centre_x_px = 8, .centre_y_px = 6}, Eigen::Isometry3d::Identity()};
  one.pose->camera_from_head.linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  one.pose->camera_from_head.translation() = Eigen::Vector3d(0.02, -0.01, -1.5);
  one.groups = {{"scene", "indoor"}, {"tone", "tan"}};
  one.licence = "CC0-1.0";
  return one;
}

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// A Radiance map of one grey with a bright texel, byte by byte: what another program may write.
inline std::string hdr_with_lamp(int width, int height, int x, int y) {
  std::string bytes =
      "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) + "\n";
  for (int i = 0; i < width * height; ++i)
    bytes += i == y * width + x ? std::string("\x80\x80\x80\x8a", 4) : std::string("\x80\x80\x80\x80", 4);
  return bytes;
}

// Through OpenImageIO itself: our own writer would not let every value pass.
inline void write_exr_with(const std::filesystem::path& path, int width, int height, float fill, float odd) {
  const OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::FLOAT);
  std::vector<float> values(static_cast<std::size_t>(width * height) * 3, fill);
  values[static_cast<std::size_t>(2 * width + 5) * 3 + 1] = odd;  // column 5, row 2
  auto file = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(file && file->open(path.string(), spec));
  ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(file->close());
}

}  // namespace faceprobe::eval::fixtures
