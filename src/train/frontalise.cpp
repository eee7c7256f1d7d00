#include "train/frontalise.h"

#include "faceprobe/core/quantile.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::train {

namespace {

constexpr double kMargin = 0.02;  // of the square, each side
// The share of triangles that is turned away further than those the foreshortening is measured against.
constexpr double kFacingQuantile = 0.95;
// Self-occlusion is looked up in a raster of this many pixels, and a surface counts as behind another when it is by
// this share of the face's size: above what a raster's pixel and the landmarks' depth err, far below how far a nose
// stands out (a seventh).
constexpr double kRasterPx = 256;
constexpr double kBehindShare = 0.04;

// A depth that orders points but leaves weights linear on the screen: far away against its own range.
Eigen::VectorXd far_away(const Eigen::VectorXd& depths) {
  const double range = depths.maxCoeff() - depths.minCoeff() + 1e-6;
  return depths.array() - depths.minCoeff() + 1e4 * range;
}

// Of the triangle in a picture with y down; positive when it faces the camera.
double facing_area(const Eigen::MatrixX2d& points, const Eigen::RowVector3i& triangle) {
  const Eigen::RowVector2d a = points.row(triangle(1)) - points.row(triangle(0));
  const Eigen::RowVector2d b = points.row(triangle(2)) - points.row(triangle(0));
  return 0.5 * (a.y() * b.x() - a.x() * b.y());
}

std::vector<bool> well_seen(const FaceTemplate& square, const Eigen::MatrixX2d& points, double max_foreshortening) {
  const auto count = static_cast<std::size_t>(square.triangles.rows());
  std::vector<double> enlargement(count);  // px^2 per m^2: the cosine of the turn, times what all share
  for (std::size_t t = 0; t < count; ++t) {
    const auto i = static_cast<Eigen::Index>(t);
    enlargement[t] = facing_area(points, square.triangles.row(i)) / square.areas_m2(i);
  }
  const double facing = quantile_of(enlargement, kFacingQuantile);
  std::vector<bool> seen(count);
  for (std::size_t t = 0; t < count; ++t) {
    seen[t] = enlargement[t] > 0 && enlargement[t] * max_foreshortening >= facing;
  }
  return seen;
}

template <class Values>
auto interpolated(const FaceTemplate& square, const face::Fragment& at, const Values& values) {
  const Eigen::RowVector3d w = at.weights.cast<double>().transpose();
  const Eigen::RowVector3i corner = square.triangles.row(at.triangle);
  return (w(0) * values.row(corner(0)) + w(1) * values.row(corner(1)) + w(2) * values.row(corner(2))).eval();
}

// What is nearest to the camera at each place of the photo.
class NearestSurface {
 public:
  NearestSurface(const FaceTemplate& square, const Eigen::MatrixX2d& points, const Eigen::VectorXd& depths)
      : square_(square), depths_(depths), low_(points.colwise().minCoeff()) {
    const double side = std::max((points.colwise().maxCoeff() - low_).maxCoeff(), 1e-6);
    scale_ = kRasterPx / side;
    behind_ = kBehindShare * side;
    const Eigen::MatrixX2d scaled = (points.rowwise() - low_) * scale_;
    fragments_ = face::rasterize_triangles(scaled, far_away(depths), square.triangles, kSide, kSide);
  }

  bool hides(const Eigen::RowVector2d& place, double depth) const {
    const Eigen::RowVector2i cell = ((place - low_) * scale_).array().floor().cast<int>().max(0).min(kSide - 1);
    const face::Fragment& nearest = fragments_[static_cast<std::size_t>(cell.y() * kSide + cell.x())];
    return nearest.triangle >= 0 && depth - interpolated(square_, nearest, depths_)(0) > behind_;
  }

 private:
  static constexpr int kSide = static_cast<int>(kRasterPx) + 1;
  const FaceTemplate& square_;
  const Eigen::VectorXd& depths_;
  Eigen::RowVector2d low_;
  double scale_ = 1;
  double behind_ = 0;
  std::vector<face::Fragment> fragments_;
};

}  // namespace

std::string WarpOptions::validate() const {
  if (!(max_foreshortening > 1) || !std::isfinite(max_foreshortening)) return "max_foreshortening must be above 1.";
  return {};
}

FaceTemplate face_template(const face::CanonicalMesh& mesh, int size_px) {
  if (size_px < 8 || size_px > 4096) throw std::invalid_argument("The template's size must be from 8 to 4096 pixels.");
  FaceTemplate square;
  square.size_px = size_px;
  square.triangles = mesh.triangles;
  const double size = size_px;
  const Eigen::MatrixX3d vertices = mesh.vertices_m.cast<double>();
  square.positions_px = vertices.leftCols<2>();
  square.positions_px.col(1) *= -1;
  const Eigen::RowVector2d low = square.positions_px.colwise().minCoeff();
  const Eigen::RowVector2d extent = square.positions_px.colwise().maxCoeff() - low;
  const double scale = size * (1 - 2 * kMargin) / extent.maxCoeff();
  const Eigen::RowVector2d middle = low + 0.5 * extent;
  square.positions_px = ((square.positions_px.rowwise() - middle) * scale).array() + 0.5 * size;
  square.areas_m2.resize(mesh.triangles.rows());
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3d a = vertices.row(mesh.triangles(t, 1)) - vertices.row(mesh.triangles(t, 0));
    const Eigen::RowVector3d b = vertices.row(mesh.triangles(t, 2)) - vertices.row(mesh.triangles(t, 0));
    square.areas_m2(t) = 0.5 * a.cross(b).norm();
  }
  square.pixels =
      face::rasterize_triangles(square.positions_px, far_away(-vertices.col(2)), square.triangles, size_px, size_px);
  return square;
}

ByteImage template_regions(const FaceTemplate& square, const std::vector<Region>& triangle_regions) {
  if (triangle_regions.size() != static_cast<std::size_t>(square.triangles.rows())) {
    throw std::invalid_argument("A region for each triangle is needed.");
  }
  ByteImage regions(square.size_px, square.size_px, 1, static_cast<std::uint8_t>(Region::kNone));
  for (std::size_t i = 0; i < square.pixels.size(); ++i) {
    const int triangle = square.pixels[i].triangle;
    if (triangle < 0) continue;
    regions.data()[i] = static_cast<std::uint8_t>(triangle_regions[static_cast<std::size_t>(triangle)]);
  }
  return regions;
}

Warp face_warp(const FaceTemplate& square, const WarpLandmarks& landmarks, const PhotoSize& photo,
               const WarpOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  const Eigen::Index count = square.positions_px.rows();
  const bool with_depth = landmarks.depth_px.size() > 0;
  if (landmarks.photo_px.rows() != count || (with_depth && landmarks.depth_px.size() != count)) {
    throw std::invalid_argument("The warp needs one landmark for each vertex of the mesh.");
  }
  if (!landmarks.photo_px.allFinite() || !landmarks.depth_px.allFinite()) {
    throw std::invalid_argument("The warp needs finite landmarks.");
  }
  if (photo.width < 1 || photo.height < 1) throw std::invalid_argument("The warp needs a photo with pixels.");

  const Eigen::MatrixX2d points = landmarks.photo_px.cast<double>();
  // All at one depth, nothing is behind anything.
  Eigen::VectorXd depths = Eigen::VectorXd::Zero(count);
  if (with_depth) depths = landmarks.depth_px.cast<double>();
  const std::vector<bool> usable = well_seen(square, points, static_cast<double>(options.max_foreshortening));
  const NearestSurface nearest(square, points, depths);
  Warp warp{square.size_px, photo, std::vector<Source>(square.pixels.size())};
  for (std::size_t i = 0; i < square.pixels.size(); ++i) {
    const face::Fragment& at = square.pixels[i];
    if (at.triangle < 0) continue;
    const Eigen::RowVector2d place = interpolated(square, at, points);
    Source& source = warp.sources[i];
    source.x_px = static_cast<float>(place.x());
    source.y_px = static_cast<float>(place.y());
    const bool on_photo = source.x_px >= 0.5F && source.x_px <= static_cast<float>(photo.width) - 0.5F &&
                          source.y_px >= 0.5F && source.y_px <= static_cast<float>(photo.height) - 0.5F;
    if (!usable[static_cast<std::size_t>(at.triangle)] || nearest.hides(place, interpolated(square, at, depths)(0))) {
      source.reach = Reach::kOccluded;
    } else {
      source.reach = on_photo ? Reach::kSeen : Reach::kOffPhoto;
    }
  }
  return warp;
}

std::array<Corner, 4> corners_of(const Source& source, const PhotoSize& photo) {
  const int x = std::clamp(static_cast<int>(std::floor(source.x_px - 0.5F)), 0, std::max(0, photo.width - 2));
  const int y = std::clamp(static_cast<int>(std::floor(source.y_px - 0.5F)), 0, std::max(0, photo.height - 2));
  const float u = source.x_px - 0.5F - static_cast<float>(x);
  const float v = source.y_px - 0.5F - static_cast<float>(y);
  const int right = std::min(x + 1, photo.width - 1);
  const int below = std::min(y + 1, photo.height - 1);
  return {{{x, y, (1 - u) * (1 - v)}, {right, y, u * (1 - v)}, {x, below, (1 - u) * v}, {right, below, u * v}}};
}

ByteImage seen(const Warp& warp) {
  ByteImage mask(warp.size_px, warp.size_px, 1);
  std::transform(warp.sources.begin(), warp.sources.end(), mask.data(),
                 [](const Source& source) { return static_cast<std::uint8_t>(source.reach == Reach::kSeen ? 255 : 0); });
  return mask;
}

Image sample(const Image& picture, const Warp& warp) {
  if (picture.width() != warp.photo.width || picture.height() != warp.photo.height) {
    throw std::invalid_argument("The picture has not the size that the warp was made for.");
  }
  const int channels = picture.channels();
  Image square(warp.size_px, warp.size_px, channels);
  float* out = square.data();
  for (const Source& source : warp.sources) {
    if (source.reach == Reach::kSeen) {
      for (const Corner& corner : corners_of(source, warp.photo)) {
        const float* from = picture.pixel(corner.x, corner.y);
        for (int c = 0; c < channels; ++c) out[c] += corner.weight * from[c];
      }
    }
    out += channels;
  }
  return square;
}

Image scatter(const Image& square, const Warp& warp) {
  if (square.width() != warp.size_px || square.height() != warp.size_px) {
    throw std::invalid_argument("The picture has not the size of the template.");
  }
  const int channels = square.channels();
  Image picture(warp.photo.width, warp.photo.height, channels);
  const float* from = square.data();
  for (const Source& source : warp.sources) {
    if (source.reach == Reach::kSeen) {
      for (const Corner& corner : corners_of(source, warp.photo)) {
        float* to = picture.pixel(corner.x, corner.y);
        for (int c = 0; c < channels; ++c) to[c] += corner.weight * from[c];
      }
    }
    from += channels;
  }
  return picture;
}

}  // namespace faceprobe::train
