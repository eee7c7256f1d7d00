#include "train/light_colours.h"

#include "train/finetune_guards.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <stdexcept>

namespace faceprobe::train {
namespace {

constexpr int kBlocks = 16;          // along a side of the square: a block is about as wide as a nostril
constexpr double kLeastShare = 0.3;  // of a block's pixels that are skin for it to count
constexpr int kLeastBlocks = 12;     // for a spread to mean anything
constexpr float kDark = 1e-3F;       // of a photo's mean colour; below it a ratio is noise

void check(const std::vector<SquarePhoto>& photos) {
  for (const SquarePhoto& photo : photos) {
    if (photo.linear.channels() != 3 || photo.usable.channels() != 1 || !photo.usable.same_size(photo.linear) ||
        !photo.linear.same_size(photos.front().linear))
      throw std::invalid_argument("Light colours are told from photos of one square, with flags of its size.");
  }
}

// Over its own mean colour; a photo without light stays as it is.
Image normalised(const SquarePhoto& photo) {
  Eigen::Array3d sum = Eigen::Array3d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < photo.linear.pixel_count(); ++i) {
    if (photo.usable.data()[i] == 0) continue;
    sum += Eigen::Map<const Eigen::Array3f>(photo.linear.data() + 3 * i).cast<double>();
    count += 1;
  }
  Image out = photo.linear;
  if (!(count > 0 && sum.minCoeff() > 0)) return out;
  const Eigen::Array3f gain = (count / sum).cast<float>();
  for (std::size_t i = 0; i < out.pixel_count(); ++i) Eigen::Map<Eigen::Array3f>(out.data() + 3 * i) *= gain;
  return out;
}

// What is known of a pixel by all photos.
struct Mean {
  Image colour;
  ByteImage photos;  // that show the pixel
};

Mean mean_of(const std::vector<SquarePhoto>& photos, const std::vector<Image>& pictures) {
  const int width = pictures.front().width();
  const int height = pictures.front().height();
  Mean mean{Image(width, height, 3), ByteImage(width, height, 1)};
  for (std::size_t i = 0; i < mean.photos.pixel_count(); ++i) {
    Eigen::Map<Eigen::Array3f> colour(mean.colour.data() + 3 * i);
    int count = 0;
    for (std::size_t k = 0; k < photos.size(); ++k) {
      if (photos[k].usable.data()[i] == 0) continue;
      colour += Eigen::Map<const Eigen::Array3f>(pictures[k].data() + 3 * i);
      ++count;
    }
    if (count > 0) colour /= static_cast<float>(count);
    mean.photos.data()[i] = static_cast<std::uint8_t>(std::min(count, 255));
  }
  return mean;
}

float median(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spread_of(const SquarePhoto& photo, const Image& picture, const Mean& mean) {
  Image medians(kBlocks, kBlocks, 3);
  ByteImage there(kBlocks, kBlocks, 1);
  int blocks = 0;
  const auto edge = [](int block, int size) { return block * size / kBlocks; };
  std::array<std::vector<float>, 3> ratios;
  for (int by = 0; by < kBlocks; ++by) {
    for (int bx = 0; bx < kBlocks; ++bx) {
      for (std::vector<float>& channel : ratios) channel.clear();
      const int x0 = edge(bx, picture.width());
      const int x1 = edge(bx + 1, picture.width());
      const int y0 = edge(by, picture.height());
      const int y1 = edge(by + 1, picture.height());
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          const float* usual = mean.colour.pixel(x, y);
          if (photo.usable(x, y) == 0 || mean.photos(x, y) < 2 || std::min({usual[0], usual[1], usual[2]}) < kDark)
            continue;
          for (std::size_t c = 0; c < 3; ++c) ratios[c].push_back(picture.pixel(x, y)[c] / usual[c]);
        }
      }
      const double pixels = static_cast<double>(x1 - x0) * (y1 - y0);
      if (ratios[0].empty() || static_cast<double>(ratios[0].size()) < kLeastShare * pixels) continue;
      for (std::size_t c = 0; c < 3; ++c) medians.pixel(bx, by)[c] = median(ratios[c]);
      there(bx, by) = 1;
      ++blocks;
    }
  }
  return blocks < kLeastBlocks ? 0 : chroma_spread(medians, there);
}

}  // namespace

std::vector<double> light_colour_spreads(const std::vector<SquarePhoto>& photos) {
  check(photos);
  std::vector<double> spreads(photos.size(), 0);
  if (photos.size() < 2) return spreads;
  std::vector<Image> pictures;
  pictures.reserve(photos.size());
  for (const SquarePhoto& photo : photos) pictures.push_back(normalised(photo));
  const Mean mean = mean_of(photos, pictures);
  for (std::size_t k = 0; k < photos.size(); ++k) spreads[k] = spread_of(photos[k], pictures[k], mean);
  return spreads;
}

}  // namespace faceprobe::train
