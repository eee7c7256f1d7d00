#pragma once
// A thing in the place of the face, under any distant light: what an estimated light is for, and the picture that relighting errors are
// measured on (paper Sec. 5.3, its bunny). Which light reaches which pixel is traced once; a light is then a product of a matrix and a
// vector, without noise.
//
//   const LitObject bunny(assets::load_object("stanford-bunny.obj"), {.size_px = 96});
//   const LitPictures truth = bunny.light(radiance);       // cells of SphereGrid(16) x 3
//
// Direct light with shadows; the coat also mirrors the object itself, once. No diffuse light between its parts, no ground.

#include "faceprobe/core/image.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/synth/mesh.h"

#include <Eigen/Core>
#include <memory>
#include <string>

namespace faceprobe::eval {

struct LitObjectOptions {
  int size_px = 96;  // width and height of the pictures, which the object's longer side fills
  int nside = 16;    // of the lights' sphere grid
  int threads = 0;

  std::string validate() const;
};

// size x size x 3 each, linear; 0 off the object.
struct LitPictures {
  Image diffuse;  // white Lambert surface
  Image glossy;   // the same under a smooth coat of index 1.362, the paper's "hard shiny white plastic"
};

class LitObject {
 public:
  // `mesh`: upright (+y), its front towards +z; any place and unit. Seen by an orthographic camera on +z. Throws std::invalid_argument
  // for options that do not validate and for a mesh without triangles.
  LitObject(const synth::SurfaceMesh& mesh, const LitObjectOptions& options = {});
  ~LitObject();
  LitObject(LitObject&&) noexcept;
  LitObject& operator=(LitObject&&) noexcept;
  LitObject(const LitObject&) = delete;
  LitObject& operator=(const LitObject&) = delete;

  // `radiance`: #cells x 3. Throws std::invalid_argument for another number of cells.
  LitPictures light(const Eigen::MatrixX3f& radiance) const;
  // size x size x 1: 1 where the object is.
  const ByteImage& mask() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A unit sphere of triangles, for where no other object is at hand.
synth::SurfaceMesh sphere_mesh(int rings = 96);

}  // namespace faceprobe::eval
