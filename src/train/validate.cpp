#include "train/validate.h"

#include "faceprobe/core/color.h"
#include "train/to_device.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

constexpr int kAtOnce = 16;
constexpr double kCodes = 255;

// Root mean square of each picture over the pixels that count.
torch::Tensor rms(const torch::Tensor& error, const torch::Tensor& weight) {
  const torch::Tensor sum = (error.square() * weight).sum({1, 2, 3});
  const torch::Tensor count = 3.0 * weight.sum({1, 2, 3});
  return (sum / count.clamp_min(1)).sqrt();
}

Image picture_of(const torch::Tensor& planes) {
  const torch::Tensor pixels = planes.to(torch::kCPU).permute({1, 2, 0}).contiguous();
  Image image(static_cast<int>(pixels.size(1)), static_cast<int>(pixels.size(0)), 3);
  std::copy_n(pixels.data_ptr<float>(), image.values().size(), image.data());
  return image;
}

void paste(const ByteImage& picture, int left, int top, ByteImage& sheet) {
  for (int y = 0; y < picture.height(); ++y) {
    std::copy_n(picture.pixel(0, y), 3 * picture.width(), sheet.pixel(left, top + y));
  }
}

}  // namespace

Validator::Validator(const synth::ShardReader& reader, int count, const torch::Device& device) {
  const int taken = std::min(count, reader.sample_count());
  std::vector<int> samples;
  for (int i = 0; i < taken; ++i) {
    samples.push_back(static_cast<int>((static_cast<std::int64_t>(i) * reader.sample_count()) / taken));
    if (static_cast<int>(samples.size()) < kAtOnce && i + 1 < taken) continue;
    batches_.push_back(to_device(plain_batch(reader, samples), device));
    samples.clear();
  }
}

Validation Validator::measure(const Model& model) const {
  const torch::NoGradGuard no_grad;
  model.module->eval();
  Validation sum;
  std::int64_t pictures = 0;
  for (const Batch& batch : batches_) {
    const torch::Tensor error = model.highlight(batch) - batch.highlight;
    const torch::Tensor everywhere = torch::ones_like(batch.skin);
    sum.skin += rms(error, batch.skin).sum().item<double>();
    sum.whole += rms(error, everywhere).sum().item<double>();
    sum.black_skin += rms(batch.highlight, batch.skin).sum().item<double>();
    sum.black_whole += rms(batch.highlight, everywhere).sum().item<double>();
    pictures += error.size(0);
  }
  model.module->train();
  const double scale = pictures > 0 ? kCodes / static_cast<double>(pictures) : 0.0;
  return {scale * sum.skin, scale * sum.whole, scale * sum.black_skin, scale * sum.black_whole};
}

ByteImage Validator::picture(const Model& model, int rows) const {
  const torch::NoGradGuard no_grad;
  model.module->eval();
  ByteImage sheet;
  int done = 0;
  const auto total = static_cast<int>(batches_.size());
  for (int r = 0; r < rows && total > 0; ++r) {
    const Batch& batch = batches_[static_cast<std::size_t>(r * total / rows)];
    const std::int64_t item = r % batch.linear.size(0);
    const torch::Tensor found = model.highlight(batch)[item];
    const torch::Tensor layers[4] = {batch.linear[item], 2.0 * batch.highlight[item], 2.0 * found,
                                     batch.linear[item] - found};
    for (int column = 0; column < 4; ++column) {
      const ByteImage cell = encode_srgb(picture_of(layers[column]));
      if (sheet.empty()) sheet = ByteImage(4 * cell.width(), rows * cell.height(), 3);
      paste(cell, column * cell.width(), done * cell.height(), sheet);
    }
    ++done;
  }
  model.module->train();
  return sheet;
}

}  // namespace faceprobe::train
