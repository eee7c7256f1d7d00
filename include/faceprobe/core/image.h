#pragma once
// A dense picture: row-major, channels interleaved, top left first. Pixel (x, y) covers [x, x+1) x [y, y+1), its centre is
// (x + .5, y + .5).
//
// The element type says the encoding, everywhere in this project: `Image` (float) holds LINEAR light (Rec.709 primaries where
// it has three channels, 1 = the photo's white) or plain numbers such as depth; `ByteImage` holds sRGB-ENCODED colour, or
// labels and masks where it has one channel. Conversions live in core/color.h. Nothing processes encoded colour.
//
//   Image photo(640, 480, 3);
//   photo(10, 20, 0) = 1.0F;                       // red of the pixel in column 10, row 20
//   std::span<const float> row = photo.row(20);    // 640 * 3 floats

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace faceprobe {

template <class T>
class BasicImage {
 public:
  using value_type = T;

  BasicImage() = default;
  // width, height >= 0 pixels; channels >= 1. Every value starts as `fill`.
  BasicImage(int width, int height, int channels, T fill = T{})
      : width_(width), height_(height), channels_(channels),
        values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels),
                fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  bool empty() const { return values_.empty(); }
  std::size_t pixel_count() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }
  // Whether width and height are the same; channels may differ.
  template <class U>
  bool same_size(const BasicImage<U>& other) const {
    return width_ == other.width() && height_ == other.height();
  }

  // Column x, row y, from the top left; outside the picture is an assertion.
  T& operator()(int x, int y, int channel = 0) { return values_[offset(x, y) + static_cast<std::size_t>(channel)]; }
  const T& operator()(int x, int y, int channel = 0) const {
    return values_[offset(x, y) + static_cast<std::size_t>(channel)];
  }
  // The `channels()` values of one pixel.
  T* pixel(int x, int y) { return values_.data() + offset(x, y); }
  const T* pixel(int x, int y) const { return values_.data() + offset(x, y); }
  // The `width() * channels()` values of one row.
  std::span<T> row(int y) { return {pixel(0, y), row_size()}; }
  std::span<const T> row(int y) const { return {pixel(0, y), row_size()}; }
  std::span<T> values() { return values_; }
  std::span<const T> values() const { return values_; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }

  bool operator==(const BasicImage&) const = default;

 private:
  std::size_t row_size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(channels_); }
  std::size_t offset(int x, int y) const {
    assert(x >= 0 && x < width_ && y >= 0 && y < height_);
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(channels_);
  }

  int width_ = 0;
  int height_ = 0;
  int channels_ = 1;
  std::vector<T> values_;
};

// Linear light or plain numbers; encoded colour, labels or flags.
using Image = BasicImage<float>;
using ByteImage = BasicImage<std::uint8_t>;

}  // namespace faceprobe
