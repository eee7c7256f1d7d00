#include "pipeline/face_reader.h"

#include "faceprobe/core/resample.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/upsample.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/net/both_ways.h"
#include "faceprobe/net/face_net.h"
#include "faceprobe/net/highlight_net.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace faceprobe::pipeline {

double shown_share(const face::Crop& crop, int photo_width, int photo_height) {
  const double width = crop.width / crop.scale;
  const double height = crop.height / crop.scale;
  const double shown_width = std::min(crop.x_px + width, static_cast<double>(photo_width)) - std::max(crop.x_px, 0.0);
  const double shown_height = std::min(crop.y_px + height, static_cast<double>(photo_height)) - std::max(crop.y_px, 0.0);
  return std::max(0.0, shown_width) * std::max(0.0, shown_height) / (width * height);
}

face::Crop small_crop(const face::Crop& crop) {
  constexpr int kLongSidePx = 128;  // synthetic faces of 128 px fill their pictures about as a crop does
  const Window small = shrunk(crop.width, crop.height, kLongSidePx);
  return {.x_px = crop.x_px,
          .y_px = crop.y_px,
          .scale = crop.scale * small.scale,
          .width = small.width,
          .height = small.height};
}

namespace {

// A clipped channel keeps what is diffuse, as the network has learnt, so that the highlight lacks that colour: cyan where red is clipped.
// The light had no such hole; it is taken to have been as bright there as in the channels that were not clipped.
void fill_clipped(const ByteImage& flags, const Image& picture, Image& highlight) {
  for (int y = 0; y < highlight.height(); ++y) {
    for (int x = 0; x < highlight.width(); ++x) {
      const unsigned clipped = flags(x, y) & 7U;
      if (clipped == 0 || clipped == 7U) continue;
      float* out = highlight.pixel(x, y);
      float sum = 0;
      int count = 0;
      for (unsigned c = 0; c < 3; ++c) {
        if ((clipped >> c & 1U) != 0) continue;
        sum += out[c];
        ++count;
      }
      const float others = sum / static_cast<float>(count);
      for (unsigned c = 0; c < 3; ++c) {
        if ((clipped >> c & 1U) != 0) out[c] = std::max(out[c], std::min(others, picture(x, y, static_cast<int>(c))));
      }
    }
  }
}

Image enlarged(const Image& small, const face::Crop& copy, int width, int height) {
  return face::crop_picture(small, {.x_px = 0, .y_px = 0, .scale = 1 / copy.scale, .width = width, .height = height});
}

// Each pixel has the region of the small pixel it lies in.
ByteImage enlarged(const ByteImage& small, const face::Crop& copy, int width, int height) {
  ByteImage out(width, height, 1);
  const auto inside = [](double at, int size) { return std::min(static_cast<int>(at), size - 1); };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      out(x, y) = small(inside((x + 0.5) * copy.scale, small.width()), inside((y + 0.5) * copy.scale, small.height()));
  }
  return out;
}

void make_unit(Image& normals) {
  for (std::size_t i = 0; i < normals.values().size(); i += 3) {
    Eigen::Map<Eigen::Vector3f> normal(normals.data() + i);
    const float length = normal.norm();
    if (length > 0) normal /= length;
  }
}

// The mesh's normals in the network's small picture, along its own camera's axis.
Image small_mesh(const face::FaceGeometry& geometry, const Image& small) {
  const double scale = static_cast<double>(small.width()) / geometry.normal_cam.width();
  Image mesh = face::crop_picture(
      geometry.normal_cam, {.x_px = 0, .y_px = 0, .scale = scale, .width = small.width(), .height = small.height()});
  const Eigen::Matrix3f network_from_camera = camera_from_network(geometry).transpose();
  for (std::size_t i = 0; i < mesh.values().size(); i += 3) {
    Eigen::Map<Eigen::Vector3f> normal(mesh.data() + i);
    normal = network_from_camera * Eigen::Vector3f(normal);
  }
  return mesh;
}

}  // namespace

Eigen::Matrix3f camera_from_network(const face::FaceGeometry& geometry) {
  const Image& view = geometry.view_cam;
  const Eigen::Vector3f middle(view.pixel(view.width() / 2, view.height() / 2));
  return Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), middle).toRotationMatrix();
}

struct FaceReader::Network {
  std::unique_ptr<net::HighlightNet> highlights;  // one of the two
  std::unique_ptr<net::FaceNet> face;
  int threads;

  Network(const std::filesystem::path& weights, int threads_) : threads(threads_) {
    if (net::read_model_info(weights).architecture == net::kFaceArchitecture) {
      face = std::make_unique<net::FaceNet>(weights, net::FaceNetOptions{.threads = threads});
    } else {
      highlights = std::make_unique<net::HighlightNet>(weights, net::HighlightNetOptions{.threads = threads});
    }
  }

  net::FaceLayers see(const Image& small, const ByteImage& flags, const ByteImage& mask,
                      const face::FaceGeometry& geometry) const {
    if (face) return face->layers_both_ways(small, flags, mask, small_mesh(geometry, small));
    net::FaceLayers layers;
    layers.highlight = net::highlight_both_ways(*highlights, small, flags, mask);
    return layers;
  }

  // What it sees in a small copy of the picture.
  struct Look {
    face::Crop copy;
    Image small;
    ByteImage where;  // of the picture, 1 on skin
    net::FaceLayers found;
  };
  Look look(const Image& picture, const ByteImage& flags, const ByteImage& skin,
            const face::FaceGeometry& geometry) const {
    Look look{small_crop({.width = picture.width(), .height = picture.height()}),
              {},
              ByteImage(skin.width(), skin.height(), 1),
              {}};
    look.small = face::crop_picture(picture, look.copy);
    std::transform(skin.values().begin(), skin.values().end(), look.where.values().begin(),
                   [](std::uint8_t value) { return value != 0 ? std::uint8_t{1} : std::uint8_t{0}; });
    const ByteImage small_flags = face::crop_flags(flags, look.copy);
    look.found = see(look.small, small_flags, face::crop_flags(look.where, look.copy), geometry);
    fill_clipped(small_flags, look.small, look.found.highlight);  // here, where no pixel stands apart from its neighbours
    return look;
  }

  highlight::Layers layers(const Look& look, const Image& picture) const {
    highlight::Layers layers;
    layers.highlight =
        highlight::upsample_highlight(look.found.highlight, look.small, picture, look.where, {.threads = threads});
    layers.diffuse = picture;
    for (std::size_t i = 0; i < picture.values().size(); ++i) layers.diffuse.data()[i] -= layers.highlight.data()[i];
    return layers;
  }

  static std::optional<Surface> surface(const Look& look, int width, int height) {
    const net::FaceLayers& found = look.found;
    if (found.normal_cam.empty()) return std::nullopt;
    Surface surface{enlarged(found.normal_cam, look.copy, width, height),
                    enlarged(found.normal_error_rad, look.copy, width, height),
                    enlarged(found.shading, look.copy, width, height), enlarged(found.region, look.copy, width, height)};
    if (!found.open_shading.empty()) surface.open_shading = enlarged(found.open_shading, look.copy, width, height);
    make_unit(surface.normal_cam);
    return surface;
  }
};

FaceReader::FaceReader(const EstimateOptions& options)
    : classical_{.separator = options.classical.value_or(highlight::Separator::kYang), .threads = options.threads} {
  if (options.classical) return;
  network_ = std::make_unique<Network>(options.weights.empty() ? io::data_file("face.safetensors") : options.weights,
                                       options.threads);
}

FaceReader::~FaceReader() = default;

Reading FaceReader::read(const Image& picture, const ByteImage& flags, const ByteImage& skin,
                         const face::FaceGeometry& geometry, bool enough) const {
  if (!network_) return {highlight::separate(picture, skin, classical_), {}, classical_.separator};
  const Network::Look look = network_->look(picture, flags, skin, geometry);
  Reading reading{{}, Network::surface(look, picture.width(), picture.height())};
  if (enough) {
    reading.layers = network_->layers(look, picture);
  } else {
    reading.layers = highlight::separate(picture, skin, classical_);
    reading.classical = classical_.separator;
    if (reading.surface) reading.surface->shading = reading.surface->open_shading = {};
  }
  return reading;
}

highlight::Layers FaceReader::separate(const Image& picture, const ByteImage& flags, const ByteImage& skin,
                                       const face::FaceGeometry& geometry, bool enough) const {
  if (!network_ || !enough) return highlight::separate(picture, skin, classical_);
  return network_->layers(network_->look(picture, flags, skin, geometry), picture);
}

}  // namespace faceprobe::pipeline
