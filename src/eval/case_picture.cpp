#include "eval/case_picture.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "io/decoder.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

template <class Wrong>
std::string first_wrong(const std::string& file, const Image& image, const std::string& what, const Wrong& wrong) {
  const auto values = image.values();
  const auto found = std::ranges::find_if(values, wrong);
  if (found == values.end()) return {};
  const auto pixel = static_cast<std::size_t>(found - values.begin()) / static_cast<std::size_t>(image.channels());
  const auto width = static_cast<std::size_t>(image.width());
  return file + " holds " + what + " at column " + std::to_string(pixel % width) + ", row " +
         std::to_string(pixel / width);
}

}  // namespace

Image read_numbers(const std::filesystem::path& path, const std::string& name, const io::Limits& limits) {
  const std::vector<std::byte> bytes = io::read_file(path, limits.max_file_bytes);
  const io::Header header = io::accept_header(bytes, name, limits);
  if (header.format != "exr" && header.format != "hdr")
    throw Error(ExitCode::kInput, name + " is a " + header.format + " file inside; write OpenEXR or Radiance HDR.");
  io::Decoder decoder(bytes, header, name);
  const int colours = decoder.colour_channels();
  Image picture(decoder.width(), decoder.height(), 3);
  std::vector<float> row(static_cast<std::size_t>(decoder.width()) * static_cast<std::size_t>(decoder.channels()));
  for (int y = 0; y < decoder.height(); ++y) {
    decoder.read_rows(y, 1, row.data());
    for (int x = 0; x < decoder.width(); ++x) {
      const float* from = row.data() + std::ptrdiff_t{x} * decoder.channels();
      for (int c = 0; c < 3; ++c) picture(x, y, c) = from[colours == 3 ? c : 0];
    }
  }
  return picture;
}

EnvMap read_case_map(const std::filesystem::path& path, const std::string& name, const io::Limits& limits) {
  Image picture = read_numbers(path, name, limits);
  if (picture.width() != 2 * picture.height()) {
    throw Error(ExitCode::kInput, name + " is " + std::to_string(picture.width()) + " x " +
                                      std::to_string(picture.height()) +
                                      " px; a lat-long map is twice as wide as high. Resize it.");
  }
  return EnvMap(std::move(picture));
}

std::filesystem::path map_file(const std::filesystem::path& folder, const std::string& stem,
                               const std::string& folder_name) {
  const std::filesystem::path hdr = folder / (stem + ".hdr");
  const std::filesystem::path exr = folder / (stem + ".exr");
  const bool has_hdr = std::filesystem::exists(hdr);
  const bool has_exr = std::filesystem::exists(exr);
  if (has_hdr && has_exr) {
    throw Error(ExitCode::kInput,
                folder_name + " has both " + stem + ".hdr and " + stem + ".exr; keep the one that counts.");
  }
  return has_hdr ? hdr : has_exr ? exr : std::filesystem::path();
}

std::string not_finite(const std::string& file, const Image& image) {
  const std::string found =
      first_wrong(file, image, "a value that is not finite", [](float value) { return !std::isfinite(value); });
  return found.empty() ? found : found + "; every value must be a number. Repair the pixel from its neighbours.";
}

std::string negative(const std::string& file, const Image& image) {
  const std::string found = first_wrong(file, image, "a value below 0", [](float value) { return value < 0; });
  return found.empty() ? found : found + "; light is 0 or more. Clip it.";
}

std::string black(const std::string& file, const Image& image) {
  if (std::ranges::any_of(image.values(), [](float value) { return value > 0; })) return {};
  return file + " is black; a light has a texel above 0.";
}

std::string other_size(const std::string& file, int width, int height, int photo_width, int photo_height) {
  if (width == photo_width && height == photo_height) return {};
  return file + " is " + std::to_string(width) + " x " + std::to_string(height) + " px and the photo " +
         std::to_string(photo_width) + " x " + std::to_string(photo_height) + "; they must be of one size.";
}

}  // namespace faceprobe::eval
