#include "train/validate.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "train/face_loss.h"
#include "train/layer_truth.h"
#include "train/sheet.h"
#include "train/to_device.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::train {
namespace {

constexpr int kPicturesAtOnce = 16;
constexpr double kCodes = 255;

// Root mean square of each picture over the pixels that count.
torch::Tensor rms(const torch::Tensor& error, const torch::Tensor& weight) {
  const torch::Tensor sum = (error.square() * weight).sum({1, 2, 3});
  const torch::Tensor count = 3.0 * weight.sum({1, 2, 3});
  return (sum / count.clamp_min(1)).sqrt();
}

// Mean over each picture's pixels that count, summed over pictures.
double mean_of(const torch::Tensor& values, const torch::Tensor& weight) {
  const torch::Tensor sum = (values * weight).sum({1, 2, 3});
  return (sum / weight.sum({1, 2, 3}).clamp_min(1)).sum().item<double>();
}

torch::Tensor degrees_between(const torch::Tensor& a, const torch::Tensor& b) {
  return 2 * (0.5 * chord(a, b)).clamp_max(1).asin() * degrees(1);
}

// Of the logarithm, each picture's level apart, summed over pictures.
double course_error(const torch::Tensor& log_level, const torch::Tensor& light, const torch::Tensor& known) {
  const torch::Tensor error = (log_level - light.mean(1, true).log()) * known;
  const torch::Tensor count = known.sum({1, 2, 3}).clamp_min(1);
  const torch::Tensor level = error.sum({1, 2, 3}) / count;
  const torch::Tensor square = error.square().sum({1, 2, 3}) / count - level.square();
  return square.clamp_min(0).sqrt().sum().item<double>();
}

void add_light(const torch::Tensor& log_level, const torch::Tensor& colour, const SurfaceBatch& truth, Validation& sum) {
  sum.shading += course_error(log_level, truth.shading.clamp_min(1e-4), truth.lit);
  sum.colour_deg += mean_of(degrees_between(colour, truth.shading), truth.lit);
}

void add_surface(const net::FaceSurface& found, const Batch& batch, Validation& sum) {
  const SurfaceBatch& truth = batch.surface;
  const torch::Tensor everywhere = torch::ones_like(batch.skin);
  sum.normal_deg += mean_of(degrees_between(found.normal, truth.normal), batch.skin);
  const torch::Tensor right = found.region.argmax(1, true) == truth.region.to(torch::kLong);
  sum.region_share += mean_of(right.to(torch::kFloat), everywhere);
  add_light(found.log_level, found.colour, truth, sum);
  if (!found.open_log_level.defined()) return;
  constexpr double kDark = 1e-2;  // as it is learnt (face_loss.cpp)
  const torch::Tensor known = (truth.open.amax(1, true) > 0).to(torch::kFloat);
  sum.open_shading += course_error(found.open_log_level, truth.open.clamp_min(kDark), known);
}

void add_highlight(const torch::Tensor& found, const Batch& batch, Validation& sum) {
  const torch::Tensor error = found - batch.highlight;
  const torch::Tensor everywhere = torch::ones_like(batch.skin);
  sum.skin += rms(error, batch.skin).sum().item<double>();
  sum.whole += rms(error, everywhere).sum().item<double>();
  sum.black_skin += rms(batch.highlight, batch.skin).sum().item<double>();
  sum.black_whole += rms(batch.highlight, everywhere).sum().item<double>();
}

// At the truth's level where that is known.
torch::Tensor levelled(const torch::Tensor& found, const torch::Tensor& truth, const torch::Tensor& known) {
  return found * (truth * known).sum() / (found * known).sum().clamp_min(1e-6);
}

std::vector<torch::Tensor> highlight_cells(const torch::Tensor& found, const Batch& batch, std::int64_t item) {
  return {batch.linear[item], 2.0 * batch.highlight[item], 2.0 * found, batch.linear[item] - found};
}

// Of a picture that is given without its highlights.
std::vector<torch::Tensor> layer_cells(const FoundLayers& found, const Batch& batch, std::int64_t item) {
  const LayerTruth truth = layer_truth(batch);
  const torch::Tensor known = truth.known[item];
  return {batch.linear[item],
          batch.linear[item] - batch.highlight[item],
          0.5 * known * truth.shading[item],
          0.5 * known * levelled(found.shading[item], truth.shading[item], known),
          known * truth.albedo[item],
          known * levelled(found.albedo[item], truth.albedo[item], known)};
}

Image picture_of(const torch::Tensor& planes) {
  const torch::Tensor pixels = planes.to(torch::kCPU).permute({1, 2, 0}).contiguous();
  Image image(static_cast<int>(pixels.size(1)), static_cast<int>(pixels.size(0)), 3);
  std::copy_n(pixels.data_ptr<float>(), image.values().size(), image.data());
  return image;
}

}  // namespace

Validator::Validator(const synth::ShardReader& reader, const TrainConfig& config, const torch::Device& device) {
  const int taken = std::min(config.validation_samples, reader.sample_count());
  std::vector<int> samples;
  for (int i = 0; i < taken; ++i) {
    samples.push_back(static_cast<int>((static_cast<std::int64_t>(i) * reader.sample_count()) / taken));
    if (static_cast<int>(samples.size()) < kPicturesAtOnce && i + 1 < taken) continue;
    batches_.push_back(to_device(plain_batch(reader, samples, config), device));
    samples.clear();
  }
}

Validation Validator::measure(const Model& model) const {
  const torch::NoGradGuard no_grad;
  model.module->eval();
  Validation sum;
  std::int64_t pictures = 0;
  for (const Batch& batch : batches_) {
    if (model.highlight) add_highlight(model.highlight(batch), batch, sum);
    if (model.surface) add_surface(model.surface(batch), batch, sum);
    if (model.layers) {
      const torch::Tensor light = model.layers(batch).shading.clamp_min(1e-4);  // black has no colour
      add_light(light.mean(1, true).log(), light, batch.surface, sum);
    }
    pictures += batch.linear.size(0);
  }
  model.module->train();
  const double scale = pictures > 0 ? kCodes / static_cast<double>(pictures) : 0.0;
  const double share = pictures > 0 ? 1 / static_cast<double>(pictures) : 0.0;
  return {scale * sum.skin,        scale * sum.whole,      scale * sum.black_skin,
          scale * sum.black_whole, share * sum.normal_deg, share * sum.region_share,
          share * sum.shading,     share * sum.colour_deg, share * sum.open_shading};
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
    const torch::Tensor found = model.highlight ? model.highlight(batch)[item] : torch::Tensor();
    std::vector<torch::Tensor> layers =
        model.layers ? layer_cells(model.layers(batch), batch, item) : highlight_cells(found, batch, item);
    if (model.surface) {
      const net::FaceSurface surface = model.surface(batch);
      const torch::Tensor skin = batch.skin[item];
      const torch::Tensor light = surface.log_level[item].exp() * surface.colour[item];
      layers.insert(layers.end(), {skin * (0.5 + 0.5 * batch.surface.normal[item]),
                                   skin * (0.5 + 0.5 * surface.normal[item]), 0.5 * skin * batch.surface.shading[item],
                                   0.5 * skin * light, skin * (batch.linear[item] - found) / light});
    }
    const auto columns = static_cast<int>(layers.size());
    for (int column = 0; column < columns; ++column) {
      const ByteImage cell = encode_srgb(picture_of(layers[static_cast<std::size_t>(column)].clamp_min(0)));
      if (sheet.empty()) sheet = ByteImage(columns * cell.width(), rows * cell.height(), 3);
      paste(cell, column * cell.width(), done * cell.height(), sheet);
    }
    ++done;
  }
  model.module->train();
  return sheet;
}

}  // namespace faceprobe::train
