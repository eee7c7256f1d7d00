#pragma once
// Closed surfaces made of rings: of revolution, and tubes along a curve. Each ends in a point at both ends, shares its vertices around, and
// has pairs of rings at one place where it has an edge.
//
//   const TriangleMesh rod = lathe(Profile({0, 0}).line({0.1F, 0}).line({0.1F, 1}).line({0, 1}).points(), 32);
//   const TriangleMesh wire = tube({start, b, c, end}, 0.01F, Eigen::Vector3f::UnitZ(), 32, 12);

#include "bezier.h"
#include "faceprobe/render/model.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::render {

// An ellipse: centre + cos(phi) a + sin(phi) b; a x b points along the surface. A ring of no size is a point.
struct Ring {
  Eigen::Vector3f centre, a, b;
};

// From ring to ring. Two equal rings in a row make an edge between what is before and after them. Smooth normals from the triangles.
TriangleMesh loft(const std::vector<Ring>& rings, int columns);

// A point of an outline turned about the y axis: (distance from the axis, height), and the outward normal there.
struct ProfilePoint {
  Eigen::Vector2f at, normal;
};

// An outline from its lowest point on the axis outwards and up to the axis again. Where two pieces meet at an angle it has an edge.
class Profile {
 public:
  explicit Profile(const Eigen::Vector2f& start) : end_(start) {}
  Profile& line(const Eigen::Vector2f& end);
  Profile& curve(const Eigen::Vector2f& b, const Eigen::Vector2f& c, const Eigen::Vector2f& end, int steps = 16);
  // A quarter of an ellipse inside a right angle at `corner`.
  Profile& bend(const Eigen::Vector2f& corner, const Eigen::Vector2f& end, int steps = 6);
  const std::vector<ProfilePoint>& points() const { return points_; }

 private:
  Eigen::Vector2f end_;
  std::vector<ProfilePoint> points_;
};

// The outline turned about the y axis, with the outline's own normals.
TriangleMesh lathe(const std::vector<ProfilePoint>& profile, int columns);
// Centred on the origin, with twice as many columns as steps from pole to pole.
TriangleMesh ball(float radius, int steps);
// Round, with round ends that reach `radius` beyond those of the curve, which lies in a plane at right angles to `side`.
TriangleMesh tube(const Bezier<3>& curve, float radius, const Eigen::Vector3f& side, int steps, int columns);

}  // namespace faceprobe::render
