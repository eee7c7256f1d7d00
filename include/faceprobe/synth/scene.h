#pragma once
// Figures in one space, ready for rays (Embree). The scene keeps a copy of the meshes it is given.
//
//   const Scene scene({figure});
//   bool dark = scene.occluded(point, towards_light);

#include "faceprobe/synth/mesh.h"

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace faceprobe::synth {

struct Hit {
  int figure = -1;  // -1: nothing was hit
  int part = -1;    // in the figure's meshes, or its strands when strand is true
  bool strand = false;
  int primitive = -1;  // triangle, or first point of the piece of strand
  float u = 0;         // barycentric: point = (1 - u - v) a + u b + v c; along the piece for strands
  float v = 0;         // the same
  float distance = std::numeric_limits<float>::infinity();  // along the ray, in its direction's length
};

struct ShadowRay {
  Eigen::Vector3f origin;                              // metres, the scene's frame
  Eigen::Vector3f direction;                           // unit length
  float near = 0;                                      // metres: hits nearer than this do not count
  float far = std::numeric_limits<float>::infinity();  // metres: nor do those beyond this
};

class Scene {
 public:
  // Throws std::invalid_argument when a mesh or strand names a vertex that is not there, or lacks normals; Error(kUnexpected) when Embree
  // cannot take it.
  explicit Scene(std::vector<Figure> figures);
  ~Scene();
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  // As given.
  const std::vector<Figure>& figures() const;
  int vertex_count() const;                       // of all meshes together
  int vertex_offset(int figure, int mesh) const;  // scene's number of the mesh's vertex 0
  // All meshes' vertices and normals, in the scene's numbering.
  const Eigen::MatrixX3f& vertices() const;
  const Eigen::MatrixX3f& normals() const;

  // First surface along a ray. Thread-safe. Lenses are passed unless `lenses`.
  Hit first_hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near = 0,
                float far = std::numeric_limits<float>::infinity(), bool lenses = false) const;
  // Whether anything but a lens lies between. Thread-safe.
  bool occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near = 0,
                float far = std::numeric_limits<float>::infinity()) const;
  // Many rays from one origin: out[i] = 1 where directions.row(i) is free, 0 where it is blocked. The fast way.
  void visible(const Eigen::Vector3f& origin, const Eigen::MatrixX3f& directions, std::uint8_t* out) const;
  // Many rays: out[i] = 1 where rays[i] is free. Alike ones together are faster.
  void visible(std::span<const ShadowRay> rays, std::uint8_t* out) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace faceprobe::synth
