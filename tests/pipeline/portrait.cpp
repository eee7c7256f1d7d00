#include "pipeline/portrait.h"

#include "faceprobe/io/data_files.h"

#include <unistd.h>
#include <algorithm>
#include <stdexcept>
#include <string>

namespace faceprobe::pipeline::testing {
namespace {

template <class T>
BasicImage<T> mirrored_image(const BasicImage<T>& image) {
  BasicImage<T> out(image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x)
      std::copy_n(image.pixel(x, y), image.channels(), out.pixel(image.width() - 1 - x, y));
  }
  return out;
}

template <class T>
BasicImage<T> doubled_image(const BasicImage<T>& image) {
  BasicImage<T> out(2 * image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y) {
    for (const int at : {0, image.width()}) std::copy_n(image.pixel(0, y), image.row(y).size(), out.pixel(at, y));
  }
  return out;
}

}  // namespace

std::filesystem::path portrait_file() { return io::data_file("samples/grace_hopper.jpg"); }

const io::Photo& portrait() {
  static const io::Photo one = io::load_photo(portrait_file());
  return one;
}

const Estimate& portrait_estimate() {
  static const Estimate one = Estimator().estimate(portrait());
  return one;
}

io::Photo mirrored(const io::Photo& photo) {
  io::Photo out = photo;
  out.linear = mirrored_image(photo.linear);
  out.clipped = mirrored_image(photo.clipped);
  return out;
}

io::Photo dimmed(const io::Photo& photo, float gain) {
  io::Photo out = photo;
  for (float& value : out.linear.values()) value *= gain;
  return out;
}

io::Photo twice_side_by_side(const io::Photo& photo) {
  io::Photo out = photo;
  out.linear = doubled_image(photo.linear);
  out.clipped = doubled_image(photo.clipped);
  return out;
}

io::Photo blank(int width, int height) {
  io::Photo out;
  out.linear = Image(width, height, 3, 0.4F);
  out.clipped = ByteImage(width, height, 1);
  out.format = "png";
  return out;
}

}  // namespace faceprobe::pipeline::testing
