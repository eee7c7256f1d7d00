#pragma once
// Meshes of simple shapes, collected into one.

#include "faceprobe/core/angles.h"
#include "faceprobe/synth/mesh.h"

#include <functional>
#include <span>
#include <vector>

namespace faceprobe::synth {

constexpr auto kTurn = static_cast<float>(2 * kPi);

class MeshBuilder {
 public:
  // A grid of points, `columns` to a row, turned so that (next column) x (next row) points outwards. `around`: the last column
  // joins the first. `turned`: (next row) x (next column) points outwards instead, as where rows run down a body.
  void grid(const std::vector<Eigen::Vector3f>& points, int columns, bool around, bool turned = false);
  // A round bar along a path, closed at its ends (or a ring). One radius per point, or one for all.
  void tube(std::span<const Eigen::Vector3f> path, std::span<const float> radii, int sides, bool ring = false);
  void tube(std::span<const Eigen::Vector3f> path, float radius, int sides, bool ring = false);
  void ellipsoid(const Eigen::Vector3f& centre, const Eigen::Matrix3f& axes, int rings,
                 int sides);  // axes' columns: half axes
  // A box with rounded edges; axes' columns are half axes, `sharpness` > 2 (2 = ellipsoid).
  void rounded_box(const Eigen::Vector3f& centre, const Eigen::Matrix3f& axes, float sharpness, int steps);
  // A flat shape filled from its middle; the outline counter-clockwise seen from outside. `bulge`: how far the middle stands out.
  void disc(std::span<const Eigen::Vector3f> outline, const Eigen::Vector3f& bulge);

  int vertex_count() const { return static_cast<int>(points_.size()); }
  bool empty() const { return triangles_.empty(); }
  // Colour by place; without it the material's albedo counts.
  void colour(const std::function<Eigen::Vector3f(const Eigen::Vector3f&)>& albedo_at, int first_vertex = 0);

  SurfaceMesh take(Material material, Region region, const Reflectance& reflectance);

 private:
  std::vector<Eigen::Vector3f> points_;
  std::vector<Eigen::Vector3f> albedo_;
  std::vector<Eigen::Vector3i> triangles_;
};

// Points of a smooth curve through `knots` (Catmull and Rom's spline), `per_span` to each piece, the last knot included.
std::vector<Eigen::Vector3f> smooth_path(std::span<const Eigen::Vector3f> knots, int per_span, bool ring = false);

}  // namespace faceprobe::synth
