#include "faceprobe/synth/photo_layers.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/region.h"

#include <algorithm>

namespace faceprobe::synth {
namespace {

using Point = Eigen::Vector2f;

float turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

// Andrew 1979, monotone chain.
std::vector<Point> convex_hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

void fill_convex(const std::vector<Point>& hull, ByteImage& mask) {
  for (int y = 0; y < mask.height(); ++y) {
    const float row = static_cast<float>(y) + 0.5F;
    float left = 1e9F;
    float right = -1e9F;
    for (std::size_t i = 0; i < hull.size(); ++i) {
      const Point& a = hull[i];
      const Point& b = hull[(i + 1) % hull.size()];
      if ((a.y() <= row) == (b.y() <= row)) continue;
      const float x = a.x() + (row - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      left = std::min(left, x);
      right = std::max(right, x);
    }
    for (int x = 0; x < mask.width(); ++x) {
      const float column = static_cast<float>(x) + 0.5F;
      if (column >= left && column <= right) mask(x, y) = 1;
    }
  }
}

// What the dense mesh covers, about, from the 68 landmarks: they end at the brows, the mesh nearly at the hair. A forehead is about as
// high as the nose is long; most of that is laid on top of the brows, narrower towards the hair.
std::vector<Point> with_forehead(const Eigen::MatrixX2f& landmarks68) {
  constexpr Eigen::Index kFirstBrow = 17, kLastBrow = 26, kNoseBase = 33;
  constexpr float kHeight = 0.8F, kNarrower = 0.85F;
  std::vector<Point> points;
  for (const auto& row : landmarks68.rowwise()) points.emplace_back(row.transpose());
  const Point middle = landmarks68.middleRows(kFirstBrow, kLastBrow - kFirstBrow + 1).colwise().mean().transpose();
  const Point up = middle - points[kNoseBase];
  for (Eigen::Index i = kFirstBrow; i <= kLastBrow; ++i) {
    const Point brow = points[static_cast<std::size_t>(i)];
    points.emplace_back(middle + kNarrower * (brow - middle) + kHeight * up);
  }
  return points;
}

std::vector<Point> outline_points(const FaceMarks& face) {
  if (face.dense_landmarks_px.rows() < 3)
    return face.landmarks_px.rows() == 68 ? with_forehead(face.landmarks_px) : std::vector<Point>{};
  std::vector<Point> points;
  for (const auto& row : face.dense_landmarks_px.rowwise()) points.emplace_back(row.transpose());
  return points;
}

}  // namespace

PhotoLayers photo_layers(const Sample& sample) {
  const int width = sample.photo.width();
  const int height = sample.photo.height();
  PhotoLayers layers{decode_srgb(sample.photo), Image(width, height, 3)};
  for (std::size_t pixel = 0; pixel < sample.photo.pixel_count(); ++pixel) {
    const unsigned clip = sample.clip.data()[pixel];
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t at = 3 * pixel + c;
      const float light = layers.linear.data()[at];
      const float highlight = std::max(0.0F, sample.highlight.data()[at]);
      const float diffuse = std::max(0.0F, sample.diffuse.data()[at]);
      const float whole = highlight + diffuse;
      const bool clipped = (clip >> c & 1U) != 0;
      const float own = clipped ? light - std::min(diffuse, light) : whole > 0 ? light * highlight / whole : 0.0F;
      layers.highlight.data()[at] = own;
    }
  }
  return layers;
}

ByteImage face_mask(const ViewLayers& view, float scale) {
  ByteImage mask(view.region.width(), view.region.height(), 1);
  for (const FaceMarks& face : view.faces) {
    std::vector<Point> points = outline_points(face);
    if (points.empty()) return skin_mask(view);
    Point middle = Point::Zero();
    for (const Point& point : points) middle += point / static_cast<float>(points.size());
    for (Point& point : points) point = middle + scale * (point - middle);
    fill_convex(convex_hull(std::move(points)), mask);
  }
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const auto region = static_cast<Region>(view.region.data()[i]);
    if (region == Region::kEyes || region == Region::kMouth) mask.data()[i] = 0;
  }
  return mask;
}

ByteImage skin_mask(const ViewLayers& view) {
  ByteImage mask(view.region.width(), view.region.height(), 1);
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    const auto region = static_cast<Region>(view.region.data()[i]);
    mask.data()[i] = region >= Region::kForehead && region < Region::kOther ? 1 : 0;
  }
  return mask;
}

}  // namespace faceprobe::synth
