// What the command's tests need of pictures.
//   picture_tool difference A B   "width height left top right bottom": A's size, and the box of the pixels where B is another; 0 0 0 0 for none
//   picture_tool enlarge A B      writes A at twice its size to B
//   picture_tool double A B       writes A and again A to its right to B

#include "faceprobe/core/color.h"
#include "faceprobe/core/pixel_box.h"
#include "faceprobe/core/resample.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

namespace {

using namespace faceprobe;  // NOLINT(google-build-using-namespace)

// More than two steps of 8 bits, which decoding and encoding once more may cost.
bool differ(const float* a, const float* b) {
  for (int c = 0; c < 3; ++c) {
    if (std::abs(srgb_from_linear(a[c]) - srgb_from_linear(b[c])) > 2.5F / 255) return true;
  }
  return false;
}

int difference(const Image& a, const Image& b) {
  if (!a.same_size(b)) {
    std::fprintf(stderr, "%d x %d is not %d x %d\n", a.width(), a.height(), b.width(), b.height());
    return 1;
  }
  ByteImage mask(a.width(), a.height(), 1);
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) mask(x, y) = differ(a.pixel(x, y), b.pixel(x, y)) ? 1 : 0;
  }
  const PixelBox box = box_of(mask).value_or(PixelBox{});
  std::printf("%d %d %d %d %d %d\n", a.width(), a.height(), box.left, box.top, box.right, box.bottom);
  return 0;
}

Image twice_side_by_side(const Image& a) {
  Image out(2 * a.width(), a.height(), a.channels());
  for (int y = 0; y < a.height(); ++y) {
    for (const int left : {0, a.width()}) std::copy_n(a.pixel(0, y), a.row(y).size(), out.pixel(left, y));
  }
  return out;
}

int run(const std::string& verb, const char* first, const char* second) {
  const Image a = io::load_photo(first).linear;
  if (verb == "difference") return difference(a, io::load_photo(second).linear);
  if (verb == "double") {
    io::write_picture(second, twice_side_by_side(a));
    return 0;
  }
  if (verb != "enlarge") return 2;
  io::write_picture(second,
                    resampled(a, {.scale = 2, .width = 2 * a.width(), .height = 2 * a.height()}, Outside::kEdge));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    return run(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
