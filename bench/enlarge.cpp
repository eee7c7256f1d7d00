// bench_enlarge PHOTO OUTPUT.jpg: a photo blown up to 12 megapixels (4000 x 3000, or 3000 x 4000 for an upright one), cropped
// around its centre to fit, with a little noise so that it costs a decoder what a camera's file does. No metadata. The large
// photo that bench/speed.sh measures with.

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace {

constexpr int kLong = 4000;
constexpr int kShort = 3000;
constexpr float kNoise = 2.0F / 255;  // standard deviation

void check(bool done, const OIIO::ImageBuf& buffer) {
  if (!done) throw std::runtime_error(buffer.has_error() ? buffer.geterror() : OIIO::geterror());
}

void enlarge(const std::string& photo, const std::string& output) {
  OIIO::ImageBuf source(photo);
  check(source.read(0, 0, true, OIIO::TypeDesc::FLOAT), source);
  const OIIO::ImageSpec& spec = source.spec();
  const bool upright = spec.height > spec.width;
  const int width = upright ? kShort : kLong;
  const int height = upright ? kLong : kShort;
  // The part of the photo with the wanted proportions.
  const double scale = std::max(static_cast<double>(width) / spec.width, static_cast<double>(height) / spec.height);
  const int part_width = std::min(spec.width, static_cast<int>(std::lround(width / scale)));
  const int part_height = std::min(spec.height, static_cast<int>(std::lround(height / scale)));
  const int x = spec.x + (spec.width - part_width) / 2;
  const int y = spec.y + (spec.height - part_height) / 2;
  OIIO::ImageBuf part = OIIO::ImageBufAlgo::cut(source, OIIO::ROI(x, x + part_width, y, y + part_height, 0, 1, 0, 3));
  check(!part.has_error(), part);
  OIIO::ImageBuf large = OIIO::ImageBufAlgo::resize(part, "", 0, OIIO::ROI(0, width, 0, height, 0, 1, 0, 3));
  check(!large.has_error(), large);
  check(OIIO::ImageBufAlgo::noise(large, "gaussian", 0, kNoise, false, 1), large);
  // A fresh specification carries none of the photo's metadata.
  OIIO::ImageSpec plain(width, height, 3, OIIO::TypeDesc::UINT8);
  plain.attribute("Compression", "jpeg:92");
  OIIO::ImageBuf result(plain);
  check(result.copy_pixels(large), result);
  check(result.write(output), result);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A photo blown up to 12 megapixels");
  std::string photo, output;
  app.add_option("photo", photo)->required()->check(CLI::ExistingFile);
  app.add_option("output", output, "a .jpg")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    enlarge(photo, output);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
