// bench_rerender --data DIR [--weights [NAME=]FILE ...] [--without FOLDER]: do the layers of a real photo hang together?
//
// A photo is albedo * shading + highlight. The shading should be the irradiance of some light on the normals that are seen with it, and a
// person's albedo the same in every photo. Prints how far both are from that, for the people of DIR/real/portraits/london, neutral and smiling,
// and for the other portraits and selfies, by weights of the network, so that before and after finetuning (docs/training.md) stand side by
// side. Of London's photos, which were all taken under the same lights, one light must also explain all. A shading without contrast
// would be right under any normals: how much there is stands beside.

#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/largest_face.h"
#include "net/torch/picture_tensors.h"
#include "support/photos.h"
#include "support/square.h"
#include "support/statistics.h"
#include "train/rerender_loss.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <set>

namespace {

using namespace faceprobe;
namespace fs = std::filesystem;

constexpr int kLayerPx = 128;  // as the network sees faces
constexpr int kSquarePx = 96;
constexpr double kLeastSkin = 500;  // pixels

torch::Tensor tensor_of(Image image) { return net::tensor_view(image).clone(); }

struct Seen {
  train::PhotoSurface surface;
  torch::Tensor skin;
  torch::Tensor flat_diffuse, flat_shading, flat_skin;  // 1 x C x P, in the mesh's square
};

torch::Tensor flat(const Image& layer, const train::Warp& warp) {
  return tensor_of(train::sample(layer, warp)).flatten(2);
}

// Nothing when there is no face, or too little of it.
std::optional<Seen> see(const pipeline::Estimator& estimator, const fs::path& file, const train::FaceTemplate& square) {
  const std::optional<pipeline::FaceEstimate> face = pipeline::find_largest_face(estimator, io::load_photo(file));
  if (!face || face->sources.shading != pipeline::ShadingSource::kNet) return std::nullopt;
  const Image& shading = face->shading;
  Image skin(shading.width(), shading.height(), 1);
  for (std::size_t i = 0; i < skin.pixel_count(); ++i) {
    const float* light = shading.data() + 3 * i;
    const bool usable = is_probe_skin(static_cast<Region>(face->geometry.region.data()[i])) &&
                        face->clipped.data()[i] == 0 && std::min({light[0], light[1], light[2]}) > 0;
    skin.data()[i] = usable ? 1.0F : 0.0F;
  }
  const train::Warp warp = bench::warp_of(*face, square);
  Seen seen{{tensor_of(face->geometry.normal_cam), {}, tensor_of(shading)},
            tensor_of(skin),
            flat(face->layers.diffuse, warp),
            flat(shading, warp),
            (flat(skin, warp) > 0.99).to(torch::kFloat)};
  if (seen.skin.sum().item<double>() < kLeastSkin) return std::nullopt;
  return seen;
}

double residual(const std::vector<Seen>& photos) {
  std::vector<train::PhotoSurface> surfaces;
  std::vector<torch::Tensor> skin;
  for (const Seen& photo : photos) {
    surfaces.push_back(photo.surface);
    skin.push_back(photo.skin);
  }
  return train::rerender(surfaces, skin, {}, train::Trust::kEven).residual.item<double>();
}

// NaN when they share too little skin.
double albedo_apart(const Seen& a, const Seen& b) {
  const torch::Tensor skin = torch::cat({a.flat_skin, b.flat_skin});
  if (skin.amin(0).sum().item<double>() < kLeastSkin) return std::nan("");
  return train::albedo_disagreement(torch::cat({a.flat_diffuse, b.flat_diffuse}),
                                    torch::cat({a.flat_shading, b.flat_shading}), skin)
      .item<double>();
}

void print_row(const std::string& weights, const char* set, const std::vector<Seen>& photos, bool same_light) {
  std::vector<double> residuals, contrasts;
  for (const Seen& photo : photos) {
    residuals.push_back(residual({photo}));
    contrasts.push_back(train::shading_contrast(photo.surface.shading, photo.skin).item<double>());
  }
  const double joint = same_light && photos.size() > 1 ? residual(photos) : std::nan("");
  std::printf("| %s | %s | %zu | %s | %s | %s | %s | %s |\n", weights.c_str(), set, photos.size(),
              bench::cell(bench::mean(residuals), 4).c_str(), bench::cell(bench::median(residuals), 4).c_str(),
              bench::cell(bench::quantile(residuals, 0.9), 4).c_str(), bench::cell(joint, 4).c_str(),
              bench::cell(bench::mean(contrasts), 3).c_str());
}

// Names of the photos in a folder that training has seen, as far as they tell London's people: their first three letters.
std::set<std::string> people_in(const std::string& folder) {
  std::set<std::string> people;
  if (folder.empty()) return people;
  if (!fs::is_directory(folder)) throw Error(ExitCode::kInput, folder + " is no folder.");
  for (const fs::path& file : bench::photos_below(folder)) people.insert(file.stem().string().substr(0, 3));
  return people;
}

void report(const fs::path& portraits, const std::string& name, const std::string& weights,
            const std::set<std::string>& without, std::vector<std::pair<std::string, std::vector<double>>>& apart) {
  pipeline::EstimateOptions options;
  options.weights = weights;
  options.layer_px = kLayerPx;
  const pipeline::Estimator estimator(options);
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  const train::FaceTemplate square = train::face_template(mesh, kSquarePx);
  std::array<std::vector<Seen>, 2> london;
  std::vector<double> differences;
  for (const auto& [id, files] : bench::london_pairs(portraits / "london")) {
    if (without.contains(id)) continue;
    std::array<std::optional<Seen>, 2> both;
    for (std::size_t e = 0; e < 2; ++e) {
      if (files[e].empty()) continue;
      both[e] = see(estimator, files[e], square);
      if (both[e]) london[e].push_back(*both[e]);
    }
    if (!both[0] || !both[1]) continue;
    if (const double value = albedo_apart(*both[0], *both[1]); std::isfinite(value)) differences.push_back(value);
  }
  std::vector<Seen> others;
  std::vector<fs::path> files = bench::photos_below(portraits / "cc0_selfies");
  for (const auto& entry : fs::directory_iterator(portraits)) {
    if (entry.is_regular_file() && bench::is_photo(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    if (std::optional<Seen> photo = see(estimator, file, square)) others.push_back(std::move(*photo));
  }
  print_row(name, "London, neutral", london[0], true);
  print_row(name, "London, smiling", london[1], true);
  print_row(name, "selfies, portraits", others, false);
  apart.emplace_back(name, std::move(differences));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Whether normals, albedo, shading and light make real photos again");
  std::string data;
  std::string without;
  std::vector<std::string> weights;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--weights", weights,
                 "weights to measure, FILE or NAME=FILE; default: those that come with the program");
  app.add_option("--without", without,
                 "leave out London's people of whom there are photos in this folder; default: nobody");
  CLI11_PARSE(app, argc, argv);
  if (weights.empty()) weights.emplace_back("net=");
  try {
    const torch::NoGradGuard no_gradients;
    const fs::path portraits = fs::path(data) / "real" / "portraits";
    const std::set<std::string> left_out = people_in(without);
    std::vector<std::pair<std::string, std::vector<double>>> apart;
    std::printf(
        "Mean |irradiance of the best light on the normals - shading| / (shading + .1) over skin, of a shading whose "
        "mean is "
        "1:\n\n| weights | photos of | photos | mean | median | 90 %% | one light for all | contrast of shading |\n"
        "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const std::string& named : weights) {
      const std::size_t equals = named.find('=');
      const bool has_name = equals != std::string::npos;
      const std::string file = has_name ? named.substr(equals + 1) : named;
      report(portraits, has_name ? named.substr(0, equals) : fs::path(file).stem().string(), file, left_out, apart);
    }
    std::printf(
        "\nMean relative difference of the albedos of one person, neutral and smiling, from their mean:\n\n"
        "| weights | people | mean | median | 90 %% |\n| --- | ---: | ---: | ---: | ---: |\n");
    for (const auto& [name, values] : apart) {
      std::printf("| %s | %zu | %s | %s | %s |\n", name.c_str(), values.size(),
                  bench::cell(bench::mean(values), 4).c_str(), bench::cell(bench::median(values), 4).c_str(),
                  bench::cell(bench::quantile(values, 0.9), 4).c_str());
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
