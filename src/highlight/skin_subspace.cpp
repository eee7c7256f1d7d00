#include "faceprobe/highlight/skin_subspace.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "highlight/box_sum.h"
#include "highlight/skin_light.h"
#include "highlight/skin_pixel_split.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace faceprobe::highlight {
namespace {

constexpr int kMostRounds = 50;
constexpr float kPull = 0.75F;  // of the surroundings; the rest is the person's mean
constexpr float kTrustedShare =
    0.075F;  // highlight, of the smallest channel, at which a pixel tells half of what it would
constexpr float kLeastTrust = 1e-3F;

void check_skin_sizes(const Image& linear, const ByteImage& clip, const ByteImage& mask, const Image& normal_cam) {
  const auto refuse = [](const char* what) { throw std::invalid_argument(std::string("separate_skin: ") + what); };
  if (!linear.empty() && linear.channels() != 3) refuse("the picture must have 3 channels");
  if (!clip.empty() && (!clip.same_size(linear) || clip.channels() != 1))
    refuse("the clip flags must have one channel and the size of the picture");
  if (!mask.empty() && (!mask.same_size(linear) || mask.channels() != 1))
    refuse("the mask must have one channel and the size of the picture");
  if (!normal_cam.empty() && (!normal_cam.same_size(linear) || normal_cam.channels() != 3))
    refuse("the normals must have three channels and the size of the picture");
}

float mean_level(const std::vector<SkinPixel>& pixels) {
  double sum = 0;
  for (const SkinPixel& pixel : pixels) sum += static_cast<double>(pixel.colour.mean());
  return static_cast<float>(sum / static_cast<double>(pixels.size()));
}

// What each pixel is to be like: its surroundings, those without much highlight having the most say.
void look_around(const Image& picture, const SkinSubspaceOptions& options, std::vector<SkinPixel>& pixels) {
  constexpr int kPasses = 2;
  Image sums(picture.width(), picture.height(), 4);  // trust, trust times departure
  for (const SkinPixel& pixel : pixels) {
    if (!pixel.seen()) continue;
    float smallest = pixel.colour.maxCoeff();
    for (int c = 0; c < 3; ++c)
      if (pixel.used[c]) smallest = std::min(smallest, pixel.colour[c]);
    const float share = pixel.highlight / (smallest * kTrustedShare);
    const float trust = 1 / (1 + share * share);
    float* sum = sums.data() + 4 * pixel.index;
    sum[0] = trust;
    for (int c = 0; c < 3; ++c) sum[1 + c] = trust * pixel.own[c];
  }
  const float side = std::sqrt(static_cast<float>(pixels.size()));
  const int radius = std::max(1, static_cast<int>(0.5F * options.neighbourhood * side));
  for (int pass = 0; pass < kPasses; ++pass) box_sum(sums, radius, options.threads);
  const float area = static_cast<float>((2 * radius + 1) * (2 * radius + 1));
  for (SkinPixel& pixel : pixels) {
    const float* sum = sums.data() + 4 * pixel.index;
    pixel.around = kPull / (sum[0] + kLeastTrust * area * area) * Eigen::Map<const Eigen::Vector3f>(sum + 1);
  }
}

void write_layers(const std::vector<SkinPixel>& pixels, const Eigen::Vector3f& log_skin, Layers& layers) {
  for (const SkinPixel& pixel : pixels) {
    for (int c = 0; c < 3; ++c) {
      float own = pixel.highlight * pixel.light[c];
      // Below white there is no telling how much a clipped channel held: the skin keeps what is expected of it.
      if (!pixel.used[c]) own = pixel.colour[c] - std::exp(log_skin[c] + pixel.own[c]) * pixel.shading[c];
      const std::size_t at = 3 * pixel.index + static_cast<std::size_t>(c);
      layers.highlight.data()[at] = std::clamp(own, 0.0F, pixel.colour[c]);
      layers.diffuse.data()[at] -= layers.highlight.data()[at];
    }
  }
}

}  // namespace

std::string SkinSubspaceOptions::validate() const {
  std::ostringstream sentence;
  if (rounds < 1 || rounds > kMostRounds) {
    sentence << "rounds is " << rounds << "; allowed is 1 to " << kMostRounds << ".";
    return sentence.str();
  }
  const std::pair<const char*, float> numbers[] = {
      {"melanin_deviation", melanin_deviation}, {"haemoglobin_deviation", haemoglobin_deviation},
      {"shading_deviation", shading_deviation}, {"colour_deviation", colour_deviation},
      {"highlight_share", highlight_share},     {"highlight_deviation", highlight_deviation},
      {"neighbourhood", neighbourhood}};
  for (const auto& [name, value] : numbers) {
    const float most = name == numbers[6].first ? 1.0F : 10.0F;
    if (value >= 1e-4F && value <= most) continue;
    sentence << name << " is " << value << "; allowed is 0.0001 to " << most << ".";
    return sentence.str();
  }
  return {};
}

Layers separate_skin(const Image& linear, const ByteImage& clip, const ByteImage& mask, const Image& normal_cam,
                     const SkinSubspaceOptions& options) {
  check_skin_sizes(linear, clip, mask, normal_cam);
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  Layers layers{Image(linear.width(), linear.height(), 3), linear};
  std::vector<SkinPixel> pixels = skin_pixels(linear, clip, mask, normal_cam);
  if (pixels.empty()) return layers;

  const PixelPriors priors(options, mean_level(pixels));
  SkinLight light = first_skin_light(pixels);
  for (int round = 0; round < options.rounds; ++round) {
    if (round > 0) look_around(linear, options, pixels);
    fit_skin_light(pixels, round == 0, options.threads, light);
    light_skin(light, options.highlight_share, options.threads, pixels);
    parallel_for(static_cast<int>(pixels.size()), options.threads, [&](int first, int last) {
      for (int i = first; i < last; ++i) split_pixel(priors, light.log_skin, pixels[static_cast<std::size_t>(i)]);
    });
  }
  write_layers(pixels, light.log_skin, layers);
  return layers;
}

}  // namespace faceprobe::highlight
