// bench_region_photos --data DIR [--labels FILE] [--weights FILE] [-o OUT]: where the face network sees skin, hair and glasses in real photos,
// against outlines drawn by hand (bench/labels/regions.txt). Prints intersection over union, over the whole crop of each face and where
// the face mesh lies; OUT/regions.png shows each face as photo, outlines and what was found.

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/observe.h"
#include "pipeline/camera_of.h"
#include "pipeline/face_reader.h"
#include "support/cells.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

namespace {

using namespace faceprobe;

constexpr int kCellPx = 160;

enum Kind : std::uint8_t { kBackground, kSkin, kHair, kEye, kMouth, kGlasses, kOther, kKinds };
constexpr std::array<const char*, kKinds> kKindNames = {"background", "skin",    "hair", "eye",
                                                        "mouth",      "glasses", "other"};
constexpr std::array<std::array<float, 3>, kKinds> kColours = {{{0, 0, 0},
                                                                {0.8F, 0.45F, 0.3F},
                                                                {0.3F, 0.15F, 0.05F},
                                                                {0.9F, 0.9F, 0.9F},
                                                                {0.6F, 0.05F, 0.1F},
                                                                {0.1F, 0.4F, 0.8F},
                                                                {0.2F, 0.5F, 0.2F}}};

Kind kind_of(std::uint8_t region) {
  if (is_skin(static_cast<Region>(region))) return kSkin;
  switch (static_cast<Region>(region)) {
    case Region::kHair: return kHair;
    case Region::kEyes: return kEye;
    case Region::kMouth: return kMouth;
    case Region::kGlasses: return kGlasses;
    case Region::kObject:
    case Region::kClothes: return kOther;
    default: return kBackground;
  }
}

struct Outline {
  Kind kind = kBackground;
  std::vector<Eigen::Vector2d> points_px;  // of the photo
};

struct Labelled {
  std::string photo;              // below the data folder
  std::vector<Outline> outlines;  // later ones lie over earlier ones
};

// Lines "photo PATH", then "KIND x,y x,y ..." of it; # begins a comment.
std::vector<Labelled> read_labels(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw Error(ExitCode::kInput, path.string() + " cannot be read.");
  std::vector<Labelled> labels;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string first;
    if (!(words >> first) || first[0] == '#') continue;
    if (first == "photo") {
      labels.emplace_back();
      words >> labels.back().photo;
      continue;
    }
    const auto found = std::ranges::find(kKindNames, first);
    if (labels.empty() || found == kKindNames.end())
      throw Error(ExitCode::kInput, path.string() + " has a line that begins with \"" + first + "\".");
    Outline outline{static_cast<Kind>(found - kKindNames.begin()), {}};
    double x = 0;
    double y = 0;
    char comma = 0;
    while (words >> x >> comma >> y) outline.points_px.emplace_back(x, y);
    labels.back().outlines.push_back(std::move(outline));
  }
  return labels;
}

bool inside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& at) {
  bool in = false;
  for (std::size_t i = 0, j = outline.size() - 1; i < outline.size(); j = i++) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[j];
    if ((a.y() > at.y()) != (b.y() > at.y()) && at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      in = !in;
  }
  return in;
}

ByteImage painted(const Labelled& labelled, const face::Crop& crop) {
  ByteImage kinds(crop.width, crop.height, 1);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const Eigen::Vector2d at = crop.photo_from_crop(x + 0.5, y + 0.5);
      for (const Outline& outline : labelled.outlines) {
        if (inside(outline.points_px, at)) kinds(x, y) = outline.kind;
      }
    }
  }
  return kinds;
}

struct Seen {
  Image picture;
  ByteImage truth, found, mesh;  // kinds; non-zero where the mesh is
};

class Looker {
 public:
  explicit Looker(const std::string& weights)
      : options_(options_with(weights)), reader_(options_),
        mesh_(face::load_canonical_mesh(io::data_file("canonical-face-model.obj"))) {}

  std::optional<Seen> look(const Labelled& labelled, const io::Photo& photo) const {
    const face::Camera camera = pipeline::camera_of(photo, options_).camera;
    const std::vector<face::Face> faces = finder_.find(photo.linear, camera);
    if (faces.empty()) return std::nullopt;
    const face::Face& largest = face::largest_of(faces);
    face::GeometryOptions geometry_options;
    geometry_options.long_side_px = 256;
    const face::Crop crop = face::face_crop(largest, photo.linear.width(), photo.linear.height(), geometry_options);
    const face::FaceGeometry geometry = face::rasterize(largest, camera, mesh_, crop);
    Seen seen{face::crop_picture(photo.linear, crop), painted(labelled, crop), {}, geometry.region};
    const pipeline::Reading reading = reader_.read(seen.picture, face::crop_flags(photo.clipped, crop),
                                                   pipeline::skin_regions(geometry.region), geometry, true);
    if (!reading.surface) throw Error(ExitCode::kModel, "These weights find no regions.");
    seen.found = reading.surface->region;
    std::ranges::transform(seen.found.values(), seen.found.values().begin(), kind_of);
    return seen;
  }

 private:
  static pipeline::EstimateOptions options_with(const std::string& weights) {
    pipeline::EstimateOptions options;
    options.weights = weights;
    return options;
  }

  pipeline::EstimateOptions options_;
  pipeline::FaceReader reader_;
  face::FaceFinder finder_;
  face::CanonicalMesh mesh_;
};

Image coloured(const ByteImage& kinds) {
  Image picture(kinds.width(), kinds.height(), 3);
  for (std::size_t i = 0; i < kinds.pixel_count(); ++i)
    std::ranges::copy(kColours[kinds.data()[i]], picture.data() + 3 * i);
  return picture;
}

// Intersection over union of one kind; NaN where neither has it. `where`: non-zero where it counts; empty = everywhere.
double overlap(const Seen& seen, Kind kind, const ByteImage& where) {
  double both = 0;
  double either = 0;
  for (std::size_t i = 0; i < seen.truth.pixel_count(); ++i) {
    if (!where.empty() && where.data()[i] == 0) continue;
    const bool a = seen.truth.data()[i] == kind;
    const bool b = seen.found.data()[i] == kind;
    both += a && b ? 1 : 0;
    either += a || b ? 1 : 0;
  }
  return either > 0 ? both / either : std::nan("");
}

void report(const std::vector<Seen>& all, std::size_t labelled) {
  std::printf("%zu faces of %zu photos.\n\n| | photos | mean | median | 10 %% |\n| --- | ---: | ---: | ---: | ---: |\n",
              all.size(), labelled);
  const auto row = [&](const std::string& name, Kind kind, bool on_mesh) {
    std::vector<double> values;
    for (const Seen& seen : all) {
      const double value = overlap(seen, kind, on_mesh ? seen.mesh : ByteImage());
      if (std::isfinite(value)) values.push_back(value);
    }
    if (values.empty()) return;
    std::printf("| %s | %zu | %s | %s | %s |\n", name.c_str(), values.size(),
                bench::cell(bench::mean(values), 3).c_str(), bench::cell(bench::median(values), 3).c_str(),
                bench::cell(bench::quantile(values, 0.1), 3).c_str());
  };
  row("skin", kSkin, false);
  row("skin, on the mesh", kSkin, true);
  row("hair", kHair, false);
  row("glasses", kGlasses, false);
  row("eye", kEye, false);
}

void draw(const std::vector<Seen>& all, const std::filesystem::path& to) {
  constexpr int kAcross = 4;
  const int rows = (static_cast<int>(all.size()) + kAcross - 1) / kAcross;
  ByteImage sheet(3 * kAcross * kCellPx, rows * kCellPx, 3);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int x = static_cast<int>(i) % kAcross * 3 * kCellPx;
    const int y = static_cast<int>(i) / kAcross * kCellPx;
    bench::put_cell(all[i].picture, 1, kCellPx, x, y, sheet);
    bench::put_cell(coloured(all[i].truth), 1, kCellPx, x + kCellPx, y, sheet);
    bench::put_cell(coloured(all[i].found), 1, kCellPx, x + 2 * kCellPx, y, sheet);
  }
  io::write_picture(to, sheet);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Skin, hair and glasses in real photos");
  std::string data;
  std::string labels = FACEPROBE_LABELS;
  std::string weights;
  std::string output;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--labels", labels, "outlines")->capture_default_str();
  app.add_option("--weights", weights, "weights in place of those that come with the program");
  app.add_option("-o,--out", output, "folder for the sheet");
  CLI11_PARSE(app, argc, argv);
  try {
    const Looker looker(weights);
    const std::vector<Labelled> all = read_labels(labels);
    std::vector<Seen> seen;
    for (const Labelled& labelled : all) {
      if (auto one = looker.look(labelled, io::load_photo(std::filesystem::path(data) / labelled.photo)))
        seen.push_back(std::move(*one));
    }
    report(seen, all.size());
    if (!output.empty()) {
      io::create_folder(output);
      draw(seen, std::filesystem::path(output) / "regions.png");
    }
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
