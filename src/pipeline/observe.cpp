#include "faceprobe/pipeline/observe.h"

#include "faceprobe/core/skin_reflectance.h"
#include "faceprobe/core/smooth_step.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/lighting/horizon.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace faceprobe::pipeline {

namespace {

constexpr float kLeastCosine = 0.3F;  // N.V below which a millimetre of mesh error may put a pixel off the face

// How far the face mesh's normals can be believed: the square of the cheeks' error over the region's, from a comparison with a head
// scan (cheeks 5.5 degrees, forehead 15, nose 21, eyes 21, mouth 24), softened so that no region is silenced.
float mesh_trust(Region region) {
  switch (region) {
    case Region::kCheeks: return 1.0F;
    case Region::kForehead:
    case Region::kChin:
    case Region::kJaw: return 0.6F;
    case Region::kNose:
    case Region::kUpperLip: return 0.4F;
    default: return 0.25F;
  }
}

// Of normals that come with an error of their own: on the mesh's scale, where the cheeks' 5.5 degrees have 1 and half as much again 0.6.
float stated_trust(float error_rad) {
  constexpr float kFull = 0.096F;  // radians
  const float share = kFull / std::max(error_rad, 1e-3F);
  return std::clamp(share, 0.25F, 1.0F);
}

// Pixels this close to the mesh's outline may show hair or background: the mesh is good to a few percent of the face.
constexpr double kRimShare = 0.025;

bool near_rim(const face::FaceGeometry& geometry, int x, int y) {
  const int reach = std::max(
      1, static_cast<int>(std::lround(kRimShare * std::max(geometry.region.width(), geometry.region.height()))));
  const auto outside = [&](int px, int py) {
    return px < 0 || py < 0 || px >= geometry.region.width() || py >= geometry.region.height() ||
           geometry.region(px, py) == 0;
  };
  return outside(x - reach, y) || outside(x + reach, y) || outside(x, y - reach) || outside(x, y + reach);
}

bool usable(const face::FaceGeometry& geometry, const ByteImage& flags, int x, int y) {
  const auto region = static_cast<Region>(geometry.region(x, y));
  if (!is_probe_skin(region) || (flags(x, y) & io::kTransparent) != 0 || near_rim(geometry, x, y)) return false;
  const Eigen::Map<const Eigen::Vector3f> normal(geometry.normal_cam.pixel(x, y));
  const Eigen::Map<const Eigen::Vector3f> view(geometry.view_cam.pixel(x, y));
  return normal.dot(view) > kLeastCosine;
}

void check(const face::FaceGeometry& geometry, const Image& highlight, const Image& shading, const ByteImage& flags,
           int max_patches) {
  const auto fits = [&](const auto& picture, int channels) {
    return picture.same_size(geometry.region) && picture.channels() == channels;
  };
  const bool has_error = !geometry.normal_error_rad.empty();
  if (!fits(geometry.normal_cam, 3) || !fits(geometry.position_cam_m, 3) || !fits(geometry.view_cam, 3) ||
      !fits(highlight, 3) || !fits(shading, 3) || !fits(flags, 1) || (has_error && !fits(geometry.normal_error_rad, 1)))
    throw std::invalid_argument(
        "Observations need layers, flags and geometry of one size: three channels each, and one of flags and errors.");
  if (max_patches < 1) throw std::invalid_argument("Observations need at least one patch to fill.");
}

struct Patch {
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();
  Eigen::Vector3f view = Eigen::Vector3f::Zero();
  Eigen::Vector3f highlight = Eigen::Vector3f::Zero();
  Eigen::Vector3f shading = Eigen::Vector3f::Zero();
  Eigen::Vector3f open_shading = Eigen::Vector3f::Zero();
  Eigen::Array3f clipped = Eigen::Array3f::Zero();
  float roughness = 0;
  float specular_albedo = 0;
  float trust = 0;
  float pixels = 0;
  float x = 0;
  float y = 0;
};

}  // namespace

ByteImage skin_regions(const ByteImage& region) {
  ByteImage skin(region.width(), region.height(), 1);
  std::transform(region.values().begin(), region.values().end(), skin.values().begin(),
                 [](std::uint8_t r) { return is_skin(static_cast<Region>(r)) ? r : std::uint8_t{0}; });
  return skin;
}

lighting::Observations observe(const face::FaceGeometry& geometry, const Image& highlight, const Image& shading,
                               const ByteImage& flags, int max_patches, int threads, const Image& open_shading) {
  check(geometry, highlight, shading, flags, max_patches);
  const bool has_open = !open_shading.empty();
  if (has_open && !open_shading.same_size(shading))
    throw std::invalid_argument("The open shading must have the size of the shading.");
  const int width = geometry.region.width();
  const int height = geometry.region.height();
  int skin = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) skin += usable(geometry, flags, x, y) ? 1 : 0;
  }
  const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(skin) / max_patches))));
  const int columns = (width + side - 1) / side;
  const int rows = (height + side - 1) / side;
  std::vector<Patch> grid(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!usable(geometry, flags, x, y)) continue;
      Patch& patch =
          grid[static_cast<std::size_t>(y / side) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / side)];
      const auto region = static_cast<Region>(geometry.region(x, y));
      const SkinReflectance skin_here = skin_reflectance(region);
      patch.normal += Eigen::Map<const Eigen::Vector3f>(geometry.normal_cam.pixel(x, y));
      patch.view += Eigen::Map<const Eigen::Vector3f>(geometry.view_cam.pixel(x, y));
      patch.highlight += Eigen::Map<const Eigen::Vector3f>(highlight.pixel(x, y));
      patch.shading += Eigen::Map<const Eigen::Vector3f>(shading.pixel(x, y));
      if (has_open) patch.open_shading += Eigen::Map<const Eigen::Vector3f>(open_shading.pixel(x, y));
      for (int c = 0; c < 3; ++c) patch.clipped[c] += (flags(x, y) >> c & 1) != 0 ? 1.0F : 0.0F;
      patch.roughness += skin_here.roughness;
      patch.specular_albedo += skin_here.specular_albedo;
      patch.trust +=
          geometry.normal_error_rad.empty() ? mesh_trust(region) : stated_trust(geometry.normal_error_rad(x, y));
      patch.pixels += 1;
      patch.x += static_cast<float>(x);
      patch.y += static_cast<float>(y);
    }
  }
  // A patch that is mostly border says more about its neighbours than about itself.
  const float least = 0.3F * static_cast<float>(side * side);
  std::erase_if(grid, [least](const Patch& p) { return p.pixels < std::max(1.0F, least); });

  lighting::Observations o;
  o.resize(static_cast<Eigen::Index>(grid.size()));
  if (has_open) o.open_shading.setZero(o.count(), 3);
  Eigen::MatrixX2i centres(o.count(), 2);
  for (Eigen::Index i = 0; i < o.count(); ++i) {
    const Patch& p = grid[static_cast<std::size_t>(i)];
    o.normal.row(i) = p.normal.normalized().transpose();
    o.view.row(i) = p.view.normalized().transpose();
    o.highlight.row(i) = p.highlight.transpose() / p.pixels;
    o.shading.row(i) = p.shading.transpose() / p.pixels;
    if (has_open) o.open_shading.row(i) = p.open_shading.transpose() / p.pixels;
    o.clipped.row(i) = (p.clipped / p.pixels > 0.25F).transpose();
    o.roughness[i] = p.roughness / p.pixels;
    o.specular_albedo[i] = p.specular_albedo / p.pixels;
    o.weight[i] = p.trust * std::max(1e-3F, smooth_step(kLeastCosine, 0.6F, o.normal.row(i).dot(o.view.row(i))));
    centres(i, 0) = static_cast<int>(std::lround(p.x / p.pixels));
    centres(i, 1) = static_cast<int>(std::lround(p.y / p.pixels));
  }
  if (o.count() > 0) o.horizon = lighting::horizon_tangents(geometry.position_cam_m, centres, threads);
  return o;
}

}  // namespace faceprobe::pipeline
