#include "paper/objects.h"

#include "faceprobe/core/error.h"
#include "faceprobe/eval/image_metrics.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace faceprobe::cli {

namespace {

struct NamedObject {
  const char* set;
  const char* name;
  std::optional<std::array<double, 3>> published = {};
};

// Published by SIHR, github.com/vitorsr/SIHR.
std::vector<NamedObject> known_objects() {
  using Figures = std::array<double, 3>;
  return {{"shen", "animals", Figures{30.4, 36.5, 37.5}},
          {"shen", "cups", Figures{31.6, 37.5, 38.3}},
          {"shen", "fruit", Figures{30.4, 36.2, 38.2}},
          {"shen", "masks", Figures{25.8, 33.5, 32.7}},
          {"mit", "apple"},
          {"mit", "frog2"},
          {"mit", "pear"},
          {"mit", "teabag1"},
          {"mit", "teabag2"}};
}

double psnr_8bit(const Image& image, const Image& truth) {
  const auto byte = [](float value) { return std::round(255.0 * std::clamp(static_cast<double>(value), 0.0, 1.0)); };
  double sum = 0;
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const double difference = byte(image.values()[i]) - byte(truth.values()[i]);
    sum += difference * difference;
  }
  return eval::psnr_of_rmse(std::sqrt(sum / static_cast<double>(image.values().size())));
}

Image highlight_of(const Image& picture, const Image& diffuse) {
  Image highlight = picture;
  for (std::size_t i = 0; i < highlight.values().size(); ++i)
    highlight.values()[i] = std::max(0.0F, picture.values()[i] - diffuse.values()[i]);
  return highlight;
}

ObjectLayers layers_of(const ObjectPicture& of) {
  ObjectLayers layers{.picture = read_code_values(of.picture), .diffuse = read_code_values(of.diffuse), .highlight = {}};
  if (layers.picture.same_size(layers.diffuse)) {
    layers.highlight = highlight_of(layers.picture, layers.diffuse);
    return layers;
  }
  const auto size = [](const Image& image) {
    return std::to_string(image.width()) + " x " + std::to_string(image.height());
  };
  throw Error(ExitCode::kInput, of.diffuse.string() + " is " + size(layers.diffuse) + " pixels, its picture " +
                                    size(layers.picture) + "; both have to be of one size.");
}

std::map<std::string, double> object_metrics(const Image& diffuse, const Image& highlight, const ObjectLayers& truth,
                                             int threads) {
  return {{"psnr_diffuse", psnr_8bit(diffuse, truth.diffuse)},
          {"rmse_highlight", eval::rmse(highlight, truth.highlight, {}, threads)},
          {"ssim_highlight", eval::ssim(highlight, truth.highlight, {}, threads)}};
}

}  // namespace

std::vector<ObjectPicture> object_pictures(const std::filesystem::path& folder) {
  std::vector<ObjectPicture> pictures;
  for (const NamedObject& object : known_objects()) {
    const std::filesystem::path set = folder / object.set;
    const std::string name = object.name;
    if (!std::filesystem::is_directory(set)) continue;
    pictures.push_back({object.set, name, set / (name + ".png"), set / (name + "_gt.png"), object.published});
  }
  return pictures;
}

Image read_code_values(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) throw Error(ExitCode::kInput, "Cannot read " + path.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.nchannels < 3)
    throw Error(ExitCode::kInput, path.string() + " has fewer than three channels; it has to be in colour.");
  Image image(spec.width, spec.height, 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, image.data()))
    throw Error(ExitCode::kInput, "Cannot read " + path.string() + ": " + input->geterror());
  return image;
}

TimedLayers timed_separation(const Image& picture, highlight::Separator separator, const ObjectBenchmark& options) {
  TimedLayers best{{}, std::numeric_limits<double>::infinity()};
  for (int i = 0; i < options.repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    highlight::Layers layers = highlight::separate(picture, {}, {.separator = separator, .threads = options.threads});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (seconds < best.seconds) best = {std::move(layers), seconds};
  }
  return best;
}

eval::ScoreTable measure_objects(const std::vector<ObjectPicture>& pictures, const ObjectBenchmark& options) {
  eval::ScoreTable scores;
  for (const ObjectPicture& of : pictures) {
    ObjectLayers layers = layers_of(of);
    const std::map<std::string, std::string> groups = {
        {"set", of.set},
        {"picture", of.name},
        {"pixels", std::to_string(layers.picture.width()) + " x " + std::to_string(layers.picture.height())}};
    const std::string sample = of.set + "/" + of.name;
    const Image black(layers.picture.width(), layers.picture.height(), 3);
    scores.add({"black layer", sample, groups, object_metrics(layers.picture, black, layers, options.threads)});
    for (std::size_t k = 0; k < kObjectSeparators.size(); ++k) {
      TimedLayers found = timed_separation(layers.picture, kObjectSeparators[k], options);
      std::map<std::string, double> metrics =
          object_metrics(found.layers.diffuse, found.layers.highlight, layers, options.threads);
      metrics["seconds"] = found.seconds;
      if (of.published) metrics["published"] = (*of.published)[k];
      scores.add({std::string(separator_name(kObjectSeparators[k])), sample, groups, std::move(metrics)});
      layers.found_highlights[k] = std::move(found.layers.highlight);
    }
    if (options.visit) options.visit(of, layers);
  }
  return scores;
}

}  // namespace faceprobe::cli
