#include "eval/relight_sheet.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/resample.h"

#include <algorithm>

namespace faceprobe::eval {
namespace {

constexpr float kShownWhite = 0.8F;  // of the diffuse object's brightest pixel, so that the coat has room above it

ByteImage encoded(Image image, float gain) {
  for (float& value : image.values()) value = std::clamp(gain * value, 0.0F, 1.0F);
  return encode_srgb(image);
}

}  // namespace

RelightSheet::RelightSheet(const LitObject& object, const SphereGrid& grid, int rows, int methods)
    : object_(object), grid_(grid), rows_(rows), columns_(methods + 2), side_(object.mask().width()) {
  if (rows > 0) sheet_ = ByteImage(columns_ * side_, rows * (side_ + side_ / 2), 3);
}

bool RelightSheet::takes(int visited, int total) const {
  if (row_ + 1 >= rows_) return false;
  // Row r is the first photo at or after r / rows of the way.
  return static_cast<long long>(visited) * rows_ >= static_cast<long long>(row_ + 1) * total;
}

void RelightSheet::put(const ByteImage& cell, int column, int top) {
  for (int y = 0; y < cell.height(); ++y)
    std::copy_n(cell.pixel(0, y), 3 * cell.width(), sheet_.pixel(column * side_, top + y));
}

void RelightSheet::begin_row(const ByteImage& photo, const Eigen::MatrixX3f& truth) {
  ++row_;
  const double scale = static_cast<double>(side_) / std::max(photo.width(), photo.height());
  const Image small = resampled(decode_srgb(photo), {0, 0, scale, side_, side_});
  put(encode_srgb(small), 0, row_ * (side_ + side_ / 2));
  column_ = 1;
  add(truth);
}

void RelightSheet::add(const Eigen::MatrixX3f& light) {
  const int column = column_++;
  if (light.rows() != grid_.cell_count() || !light.allFinite()) return;
  const LitPictures lit = object_.light(light);
  const float white = *std::max_element(lit.diffuse.values().begin(), lit.diffuse.values().end());
  if (!(white > 0)) return;
  const int top = row_ * (side_ + side_ / 2);
  put(encoded(lit.glossy, kShownWhite / white), column, top);
  const int height = side_ / 2;
  put(encoded(env_map_from_grid(light, grid_, 2 * height, height).radiance(), kShownWhite / white), column, top + side_);
}

ByteImage RelightSheet::picture() const {
  if (row_ < 0) return {};
  ByteImage out(sheet_.width(), (row_ + 1) * (side_ + side_ / 2), 3);
  std::copy_n(sheet_.data(), out.values().size(), out.data());
  return out;
}

}  // namespace faceprobe::eval
