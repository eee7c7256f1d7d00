#include "faceprobe/pipeline/relight.h"

#include "faceprobe/core/resample.h"
#include "faceprobe/core/skin_reflectance.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/insert/photo_look.h"
#include "faceprobe/lighting/horizon.h"
#include "faceprobe/lighting/transport.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::pipeline {
namespace {

constexpr int kNside = 8;  // 768 cells of 7 degrees: shading and skin's lobes are wider
constexpr float kLeastShare =
    0.02F;  // of the face's mean light, added to both lights: where there is none, nothing can be told
constexpr float kFadeShare = 0.03F;  // of the crop, over which the change fades out at the face's outline

// Every pixel of a small copy of the face, as rows for the transport.
struct SmallFace {
  Image normal, position, view;
  ByteImage region;
  std::vector<Eigen::Vector2i> pixels;
};

SmallFace small_face(const face::FaceGeometry& geometry, const Window& window) {
  SmallFace small{resampled(geometry.normal_cam, window),
                  nearest(geometry.position_cam_m, window),
                  resampled(geometry.view_cam, window, Outside::kEdge),
                  resampled(geometry.region, window, 0),
                  {}};
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      // Where the face meets what is not face, normals are means with nothing: half their length is the border.
      if (Eigen::Map<const Eigen::Vector3f>(small.normal.pixel(x, y)).norm() > 0.5F) small.pixels.emplace_back(x, y);
    }
  }
  return small;
}

lighting::Observations rows_of(const SmallFace& small, int threads) {
  lighting::Observations rows;
  rows.resize(static_cast<Eigen::Index>(small.pixels.size()));
  Eigen::MatrixX2i centres(rows.count(), 2);
  for (Eigen::Index i = 0; i < rows.count(); ++i) {
    const Eigen::Vector2i at = small.pixels[static_cast<std::size_t>(i)];
    const auto region = static_cast<Region>(small.region(at.x(), at.y()));
    const SkinReflectance skin = skin_reflectance(is_probe_skin(region) ? region : Region::kCheeks);
    rows.normal.row(i) = Eigen::Map<const Eigen::RowVector3f>(small.normal.pixel(at.x(), at.y())).normalized();
    rows.view.row(i) = Eigen::Map<const Eigen::RowVector3f>(small.view.pixel(at.x(), at.y())).normalized();
    rows.roughness[i] = skin.roughness;
    rows.specular_albedo[i] = skin.specular_albedo;
    centres.row(i) = at.transpose();
  }
  rows.horizon = lighting::horizon_tangents(small.position, centres, threads);
  return rows;
}

// Values of the rows as a picture that goes on beyond the face as its border does, so that enlarging does not mix in nothing.
Image spread(const SmallFace& small, const Eigen::MatrixX3f& values, int width, int height) {
  Image sum(width, height, 4);
  for (std::size_t i = 0; i < small.pixels.size(); ++i) {
    float* pixel = sum.pixel(small.pixels[i].x(), small.pixels[i].y());
    Eigen::Map<Eigen::RowVector3f>(pixel).noalias() = values.row(static_cast<Eigen::Index>(i));
    pixel[3] = 1;
  }
  const Image wide = insert::blur(sum, 3);
  Image out(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float* own = sum.pixel(x, y);
      const float* from = own[3] > 0 || !(wide(x, y, 3) > 1e-4F) ? own : wide.pixel(x, y);
      for (int c = 0; c < 3; ++c) out(x, y, c) = from[3] > 0 ? from[c] / from[3] : 0;
    }
  }
  return out;
}

// What of the light's change reaches each pixel of the crop: 1 on the face, 0 off it, soft between.
Image share_of_face(const face::FaceGeometry& geometry) {
  Image inside(geometry.crop.width, geometry.crop.height, 1);
  for (int y = 0; y < inside.height(); ++y) {
    for (int x = 0; x < inside.width(); ++x)
      inside(x, y) = Eigen::Map<const Eigen::Vector3f>(geometry.normal_cam.pixel(x, y)).squaredNorm() > 0 ? 1.0F : 0.0F;
  }
  const float sigma =
      std::clamp(kFadeShare * static_cast<float>(std::max(inside.width(), inside.height())), 0.5F, 60.0F);
  Image soft = insert::blur(inside, sigma);
  for (float& share : soft.values()) share = std::clamp(2 * share - 1, 0.0F, 1.0F);  // outside nothing changes
  return soft;
}

// How strongly this face's highlights follow the old light's lobe.
float gloss_of(const FaceEstimate& face, const SmallFace& small, const Eigen::MatrixX3f& lobe, const Window& window) {
  const Image highlight = resampled(face.layers.highlight, window);
  double product = 0;
  double square = 1e-9;
  for (std::size_t i = 0; i < small.pixels.size(); ++i) {
    const Eigen::Vector2i at = small.pixels[i];
    if (!is_probe_skin(static_cast<Region>(small.region(at.x(), at.y())))) continue;
    const Eigen::RowVector3f there = lobe.row(static_cast<Eigen::Index>(i));
    product += static_cast<double>(there.dot(Eigen::Map<const Eigen::RowVector3f>(highlight.pixel(at.x(), at.y()))));
    square += static_cast<double>(there.squaredNorm());
  }
  return static_cast<float>(product / square);
}

// What changes in the crop: a factor on all light, and what the highlights get beyond it.
struct Change {
  Image factor, highlight;
};
Change change_of(const FaceEstimate& face, const Eigen::MatrixX3f& radiance, const RelightOptions& options) {
  const face::Crop& crop = face.geometry.crop;
  const Window window = shrunk(crop.width, crop.height, options.shading_px);
  const SmallFace small = small_face(face.geometry, window);
  const SphereGrid grid(kNside);
  const lighting::Transport transport =
      lighting::build_transport(rows_of(small, options.threads), grid, options.threads);
  const Eigen::MatrixX3f before =
      grid_from_grid(face.light.radiance, SphereGrid::of_cells(face.light.radiance.rows()), grid);
  const Eigen::MatrixX3f after = grid_from_grid(radiance, SphereGrid::of_cells(radiance.rows()), grid);
  const Eigen::MatrixX3f old_shading = transport.diffuse() * before;
  const Eigen::MatrixX3f new_shading = transport.diffuse() * after;
  const float old_floor = std::max(1e-9F, kLeastShare * old_shading.mean());
  const float new_floor = kLeastShare * new_shading.mean();
  const Eigen::MatrixX3f factor =
      ((new_shading.array() + new_floor) / (old_shading.array() + old_floor)).min(options.most_gain).matrix();
  const Eigen::MatrixX3f old_lobe = transport.highlight() * before;
  const float gloss = gloss_of(face, small, old_lobe, window);
  const Eigen::MatrixX3f lobe = gloss * (transport.highlight() * after - factor.cwiseProduct(old_lobe));
  const Window back = window.back_to(crop.width, crop.height);
  return {resampled(spread(small, factor, window.width, window.height), back, Outside::kEdge),
          resampled(spread(small, lobe, window.width, window.height), back, Outside::kEdge)};
}

}  // namespace

std::string RelightOptions::validate() const {
  if (shading_px < 8 || shading_px > 512)
    return "shading_px must be from 8 to 512, found " + std::to_string(shading_px) + ".";
  if (!(most_gain >= 1 && most_gain <= 1000))
    return "most_gain must be from 1 to 1000, found " + std::to_string(most_gain) + ".";
  return {};
}

void relight(Image& photo, const FaceEstimate& face, const Eigen::MatrixX3f& radiance, const RelightOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (photo.channels() != 3) throw std::invalid_argument("A photo to relight needs three channels.");
  if (radiance.rows() != face.light.radiance.rows())
    throw std::invalid_argument("A new light needs one radiance per cell of the old one.");
  const face::Crop& crop = face.geometry.crop;
  const Change change = change_of(face, radiance, options);
  const Image share = share_of_face(face.geometry);
  // Onto the photo as a factor and a sum, so that it keeps what the crop was too small for. A highlight changes by what its lobe does, and
  // what it has beyond its lobe as the shading does; below 0 it cannot fall.
  Image pair(crop.width, crop.height, 7);
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      float* pixel = pair.pixel(x, y);
      pixel[6] = share(x, y);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = change.factor(x, y, c);
        pixel[3 + c] = std::max(change.highlight(x, y, c), -change.factor(x, y, c) * face.layers.highlight(x, y, c));
      }
    }
  }
  const Eigen::Vector2d far = crop.photo_from_crop(crop.width, crop.height);
  const int left = std::clamp(static_cast<int>(std::floor(crop.x_px)), 0, photo.width());
  const int top = std::clamp(static_cast<int>(std::floor(crop.y_px)), 0, photo.height());
  const int right = std::clamp(static_cast<int>(std::ceil(far.x())), left, photo.width());
  const int bottom = std::clamp(static_cast<int>(std::ceil(far.y())), top, photo.height());
  const Image wide = resampled(pair, {.left_px = (left - crop.x_px) * crop.scale,
                                      .top_px = (top - crop.y_px) * crop.scale,
                                      .scale = 1 / crop.scale,
                                      .width = right - left,
                                      .height = bottom - top});
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float* with = wide.pixel(x - left, y - top);
      for (int c = 0; c < 3; ++c) {
        const float relit = std::max(0.0F, with[c] * photo(x, y, c) + with[3 + c]);
        photo(x, y, c) += with[6] * (relit - photo(x, y, c));
      }
    }
  }
}

}  // namespace faceprobe::pipeline
