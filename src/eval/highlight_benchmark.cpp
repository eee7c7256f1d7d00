#include "faceprobe/eval/highlight_benchmark.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/eval/image_metrics.h"
#include "faceprobe/eval/skin_tone.h"
#include "faceprobe/synth/photo_layers.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

constexpr double kLeastSkin = 0.05;

struct Photo {
  synth::Sample sample;
  synth::PhotoLayers layers;
  ByteImage face;  // mask that the method is given
  ByteImage skin;  // where it is judged

  Photo(const synth::ShardReader& faces, int number)
      : sample(faces.copy_sample(number)), layers(synth::photo_layers(sample)) {
    const synth::ViewLayers view = faces.copy_view(number);
    face = synth::face_mask(view, 1.0F);
    skin = synth::skin_mask(view);
    for (std::size_t i = 0; i < skin.values().size(); ++i) skin.data()[i] = skin.data()[i] & face.data()[i];
  }

  double skin_share() const {
    return static_cast<double>(std::count(skin.values().begin(), skin.values().end(), 1)) /
           static_cast<double>(skin.pixel_count());
  }
};

// Evenly over the data set, with enough skin to judge by.
std::vector<int> chosen(const synth::ShardReader& faces, int count) {
  std::vector<int> numbers;
  numbers.reserve(static_cast<std::size_t>(count));
  const int taken = std::min(count, faces.sample_count());
  for (int i = 0; i < taken; ++i)
    numbers.push_back(static_cast<int>((static_cast<long long>(i) * faces.sample_count()) / taken));
  return numbers;
}

std::map<std::string, std::string> groups_of(const Photo& photo) {
  Eigen::Vector3d albedo = Eigen::Vector3d::Zero();
  double clipped = 0;
  double count = 0;
  for (std::size_t i = 0; i < photo.skin.pixel_count(); ++i) {
    if (photo.skin.data()[i] == 0) continue;
    albedo += Eigen::Map<const Eigen::Vector3f>(photo.sample.albedo.data() + 3 * i).cast<double>();
    clipped += photo.sample.clip.data()[i] != 0 ? 1 : 0;
    ++count;
  }
  const double share = clipped / count;
  const double skin = photo.skin_share();
  return {{"tone", std::string(skin_tone_name(skin_tone(ita_deg(albedo / count))))},
          {"clipped", share < 0.001  ? "none"
                      : share < 0.05 ? "under 5 %"
                                     : "5 % and more"},
          {"size", skin < 0.15   ? "under 15 %"
                   : skin < 0.25 ? "15 to 25 %"
                                 : "25 % and more"}};
}

Image picture_times(const Image& image, float factor) {
  Image out = image;
  for (float& value : out.values()) value *= factor;
  return out;
}

}  // namespace

HighlightMethod black_method() {
  return {"black layer", [](const Image& linear, const ByteImage&, const ByteImage&) {
            return Image(linear.width(), linear.height(), 3);
          }};
}

std::string HighlightBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

ScoreTable measure_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods,
                              const HighlightBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  ScoreTable table;
  std::vector<std::string> tones;
  tones.reserve(kSkinTones.size());
  for (const SkinTone tone : kSkinTones) tones.emplace_back(skin_tone_name(tone));
  table.order_labels("tone", tones);
  table.order_labels("clipped", {"none", "under 5 %", "5 % and more"});
  table.order_labels("size", {"under 15 %", "15 to 25 %", "25 % and more"});
  const std::vector<int> numbers = chosen(faces, options.samples);
  int done = 0;
  for (const int number : numbers) {
    const Photo photo(faces, number);
    ++done;
    if (photo.skin_share() >= kLeastSkin) {
      const std::map<std::string, std::string> groups = groups_of(photo);
      for (const HighlightMethod& method : methods) {
        const Image masked = method.highlight(photo.layers.linear, photo.sample.clip, photo.face);
        const Image whole = method.highlight(photo.layers.linear, photo.sample.clip, {});
        const Image& truth = photo.layers.highlight;
        table.add({method.name,
                   std::to_string(number),
                   groups,
                   {{"rmse_skin", rmse(masked, truth, photo.skin, options.threads)},
                    {"ssim_skin", ssim(masked, truth, photo.skin, options.threads)},
                    {"rmse_whole", rmse(whole, truth, {}, options.threads)},
                    {"ssim_whole", ssim(whole, truth, {}, options.threads)}}});
      }
    }
    if (options.progress) options.progress(done, static_cast<int>(numbers.size()));
  }
  return table;
}

ByteImage draw_highlights(const synth::ShardReader& faces, const std::vector<HighlightMethod>& methods, int rows) {
  ByteImage sheet;
  int row = 0;
  for (const int number : chosen(faces, rows)) {
    const Photo photo(faces, number);
    std::vector<Image> columns = {photo.layers.linear, picture_times(photo.layers.highlight, 2.0F)};
    columns.reserve(2 + methods.size());
    for (const HighlightMethod& method : methods)
      columns.push_back(picture_times(method.highlight(photo.layers.linear, photo.sample.clip, {}), 2.0F));
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
