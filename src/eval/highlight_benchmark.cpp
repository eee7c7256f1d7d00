#include "faceprobe/eval/highlight_benchmark.h"

#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/image_metrics.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

Image picture_times(const Image& image, float factor) {
  Image out = image;
  for (float& value : out.values()) value *= factor;
  return out;
}

// Three equal channels, each the mean of what they were.
Image averaged(const Image& image) {
  Image out = image;
  for (std::size_t i = 0; i < out.values().size(); i += 3) {
    float* pixel = out.data() + i;
    pixel[0] = pixel[1] = pixel[2] = (pixel[0] + pixel[1] + pixel[2]) / 3;
  }
  return out;
}

// The photo as a grey one, and what is true of it.
SyntheticPhoto made_grey(SyntheticPhoto photo) {
  photo.layers.linear = averaged(photo.layers.linear);
  photo.layers.highlight = averaged(photo.layers.highlight);
  photo.sample.photo = encode_srgb(photo.layers.linear);
  photo.layers.linear = decode_srgb(photo.sample.photo);
  constexpr std::uint8_t kAllChannels = 7;  // a grey pixel is at its end where all that it was made of were
  for (std::uint8_t& flags : photo.sample.clip.values())
    flags = (flags & kAllChannels) == kAllChannels ? kAllChannels : 0;
  return photo;
}

void add_rows(ScoreTable& table, int number, const SyntheticPhoto& photo, const std::vector<HighlightMethod>& methods,
              const HighlightBenchmark& options) {
  const std::map<std::string, std::string> groups = {
      {"tone", photo.tone()}, {"clipped", photo.clipped()}, {"size", photo.size()}};
  const Image& truth = photo.layers.highlight;
  for (const HighlightMethod& method : methods) {
    Image masked = method.highlight(photo.input());
    Image whole = method.highlight(photo.whole_input());
    if (options.grey) {
      masked = averaged(masked);
      whole = averaged(whole);
    }
    const double error = rmse(masked, truth, photo.skin, options.threads);
    const double error_whole = rmse(whole, truth, {}, options.threads);
    table.add({method.name,
               std::to_string(number),
               groups,
               {{"rmse_skin", error},
                {"psnr_skin", psnr_of_rmse(error)},
                {"ssim_skin", ssim(masked, truth, photo.skin, options.threads)},
                {"rmse_whole", error_whole},
                {"psnr_whole", psnr_of_rmse(error_whole)},
                {"ssim_whole", ssim(whole, truth, {}, options.threads)}},
               photo.person});
  }
}

}  // namespace

HighlightMethod black_method() {
  return {"black layer", [](const PhotoInput& input) { return Image(input.linear.width(), input.linear.height(), 3); }};
}

std::string HighlightBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

ScoreTable measure_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods,
                              const HighlightBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  ScoreTable table;
  table.order_labels("tone", tone_names());
  table.order_labels("clipped", clipped_names());
  table.order_labels("size", size_names());
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    if (options.grey) {
      add_rows(table, number, made_grey(photo), methods, options);
    } else {
      add_rows(table, number, photo, methods, options);
    }
  });
  return table;
}

ByteImage draw_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods, int rows) {
  ByteImage sheet;
  int row = 0;
  for (const int number : chosen_by_person(faces, rows)) {
    const SyntheticPhoto photo(faces, number);
    std::vector<Image> columns = {photo.layers.linear, picture_times(photo.layers.highlight, 2.0F)};
    columns.reserve(2 + methods.size());
    for (const HighlightMethod& method : methods)
      columns.push_back(picture_times(method.highlight(photo.whole_input()), 2.0F));
    const int width = photo.layers.linear.width();
    const int height = photo.layers.linear.height();
    if (sheet.empty()) sheet = ByteImage(static_cast<int>(columns.size()) * width, rows * height, 3);
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const ByteImage cell = encode_srgb(columns[c]);
      for (int y = 0; y < height; ++y) {
        std::copy_n(cell.pixel(0, y), 3 * width, sheet.pixel(static_cast<int>(c) * width, row * height + y));
      }
    }
    ++row;
  }
  return sheet;
}

}  // namespace faceprobe::eval
