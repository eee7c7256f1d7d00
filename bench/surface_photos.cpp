// bench_surface_photos --data DIR [--weights FILE] -o OUT: normals, albedo and shading of real photos, whose truth nobody knows.
//
// Of the people of DIR/real/portraits/london, photographed neutral and smiling under the same lights, prints how much their albedo differs
// between the two, brought into the mesh's own square, beside how much the photos do: a skin does not change with its expression. Draws
// OUT/surface.png to look at: each face as photo, normals, albedo, shading, and that albedo on those normals under a lamp at its left.

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/largest_face.h"
#include "support/cells.h"
#include "support/photos.h"
#include "support/square.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace {

using namespace faceprobe;
namespace fs = std::filesystem;

constexpr int kCellPx = 160;
constexpr int kSquarePx = 96;

// Zero off the skin: what is outside has no albedo to speak of.
Image on_skin(const pipeline::FaceEstimate& face, const Image& layer) {
  Image out(layer.width(), layer.height(), layer.channels());
  for (int y = 0; y < layer.height(); ++y) {
    for (int x = 0; x < layer.width(); ++x) {
      if (is_skin(static_cast<Region>(face.geometry.region(x, y))))
        std::copy_n(layer.pixel(x, y), layer.channels(), out.pixel(x, y));
    }
  }
  return out;
}

Image relit(const pipeline::FaceEstimate& face) {
  const Eigen::Vector3f lamp = Eigen::Vector3f(0.8F, 0.35F, 0.5F).normalized();
  constexpr float kBrightness = 1.6F;
  Image out = on_skin(face, face.albedo);
  for (std::size_t i = 0; i < out.pixel_count(); ++i) {
    const Eigen::Map<const Eigen::Vector3f> normal(face.geometry.normal_cam.data() + 3 * i);
    const float cosine = std::max(0.02F, normal.dot(lamp));
    for (std::size_t c = 0; c < 3; ++c) out.data()[3 * i + c] *= kBrightness * cosine;
  }
  return out;
}

Image normals_picture(const pipeline::FaceEstimate& face) {
  Image out = on_skin(face, face.geometry.normal_cam);
  for (std::size_t i = 0; i < out.values().size(); ++i)
    out.data()[i] = out.data()[i] == 0 ? 0 : linear_from_srgb(0.5F + 0.5F * out.data()[i]);
  return out;
}

void draw(const pipeline::Estimator& estimator, const std::vector<fs::path>& files, const fs::path& to) {
  constexpr int kAcross = 3;
  constexpr int kCells = 5;
  std::vector<pipeline::FaceEstimate> faces;
  for (const fs::path& file : files) {
    if (auto face = pipeline::find_largest_face(estimator, io::load_photo(file))) faces.push_back(std::move(*face));
  }
  if (faces.empty()) throw Error(ExitCode::kInput, "There are no photos with a face to draw.");
  const int rows = (static_cast<int>(faces.size()) + kAcross - 1) / kAcross;
  ByteImage sheet(kCells * kAcross * kCellPx, rows * kCellPx, 3);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const int x = static_cast<int>(i) % kAcross * kCells * kCellPx;
    const int y = static_cast<int>(i) / kAcross * kCellPx;
    const auto put = [&](int cell, const Image& picture, float gain) {
      bench::put_cell(picture, gain, kCellPx, x + cell * kCellPx, y, sheet);
    };
    put(0, faces[i].picture, 1);
    put(1, normals_picture(faces[i]), 1);
    put(2, on_skin(faces[i], faces[i].albedo), 1);
    put(3, faces[i].shading, 0.4F);
    put(4, relit(faces[i]), 1);
  }
  io::write_picture(to, sheet);
}

// A layer in the square, and where it is known.
struct Flat {
  Image layer;
  Image known;
};

Flat flatten(const pipeline::FaceEstimate& face, const Image& layer, const train::FaceTemplate& square) {
  const train::Warp warp = bench::warp_of(face, square);
  Image skin(layer.width(), layer.height(), 1);
  for (std::size_t i = 0; i < skin.pixel_count(); ++i)
    skin.data()[i] =
        is_probe_skin(static_cast<Region>(face.geometry.region.data()[i])) && face.clipped.data()[i] == 0 ? 1.0F : 0.0F;
  return {train::sample(layer, warp), train::sample(skin, warp)};
}

// Root mean square difference over the root mean square, after the best scale; NaN with too little skin in common.
double difference(const Flat& a, const Flat& b) {
  double aa = 0;
  double ab = 0;
  double bb = 0;
  int count = 0;
  for (std::size_t i = 0; i < a.known.pixel_count(); ++i) {
    if (a.known.data()[i] < 0.99F || b.known.data()[i] < 0.99F) continue;
    ++count;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto x = static_cast<double>(a.layer.data()[3 * i + c]);
      const auto y = static_cast<double>(b.layer.data()[3 * i + c]);
      aa += x * x;
      ab += x * y;
      bb += y * y;
    }
  }
  return count < 500 ? std::nan("") : std::sqrt(std::max(0.0, 1 - ab * ab / (aa * bb)));
}

void report(const fs::path& london, const std::string& weights) {
  const face::CanonicalMesh mesh = face::load_canonical_mesh(io::data_file("canonical-face-model.obj"));
  const train::FaceTemplate square = train::face_template(mesh, kSquarePx);
  std::printf(
      "Difference between one person neutral and smiling, root mean square over the root mean square, skin in the "
      "mesh's "
      "square, at the best scale:\n\n| | people | mean | median | 90 %% |\n| --- | ---: | ---: | ---: | ---: |\n");
  const auto row = [](const std::string& name, const std::vector<double>& values) {
    std::printf("| %s | %zu | %s | %s | %s |\n", name.c_str(), values.size(),
                bench::cell(bench::mean(values), 3).c_str(), bench::cell(bench::median(values), 3).c_str(),
                bench::cell(bench::quantile(values, 0.9), 3).c_str());
  };
  bool photos_told = false;
  for (const auto& [name, source] : {std::pair("albedo by net", pipeline::ShadingSource::kNet),
                                     std::pair("albedo by region", pipeline::ShadingSource::kRegions)}) {
    pipeline::EstimateOptions options;
    options.weights = weights;
    options.layer_px = 2 * kSquarePx;  // more would alias in the square
    options.shading = source;
    const pipeline::Estimator estimator(options);
    std::vector<double> photos, albedos;
    for (const auto& [id, files] : bench::london_pairs(london)) {
      if (files[0].empty() || files[1].empty()) continue;
      const auto neutral = pipeline::find_largest_face(estimator, io::load_photo(files[0]));
      const auto smiling = pipeline::find_largest_face(estimator, io::load_photo(files[1]));
      if (!neutral || !smiling) continue;
      const double photo =
          difference(flatten(*neutral, neutral->picture, square), flatten(*smiling, smiling->picture, square));
      if (!std::isfinite(photo)) continue;
      photos.push_back(photo);
      albedos.push_back(
          difference(flatten(*neutral, neutral->albedo, square), flatten(*smiling, smiling->albedo, square)));
    }
    if (!photos_told) row("photos", photos);
    photos_told = true;
    row(name, albedos);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Normals, albedo and shading of real photos");
  std::string data;
  std::string weights;
  std::string output = "out/surface_photos";
  bool sheets = true;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--weights", weights, "weights in place of those that come with the program");
  app.add_option("-o,--out", output, "folder for the sheet")->capture_default_str();
  app.add_flag("!--no-sheets", sheets, "only the table");
  CLI11_PARSE(app, argc, argv);
  try {
    const fs::path london = fs::path(data) / "real" / "portraits" / "london";
    if (sheets) {
      io::create_folder(output);
      pipeline::EstimateOptions options;
      options.weights = weights;
      options.layer_px = 2 * kSquarePx;
      draw(pipeline::Estimator(options), bench::every_nth(bench::photos_below(london / "neutral_front"), 2),
           fs::path(output) / "surface.png");
    }
    report(london, weights);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
