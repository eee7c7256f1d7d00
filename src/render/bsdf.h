#pragma once
// A material at a point: how much light from one direction goes to the viewer, and where to look for it. World directions, all pointing away
// from the point; `view` must be on the side of `normal`.

#include "faceprobe/render/material.h"
#include "render/ggx.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>

namespace faceprobe::render {

// A material with what is worked out once.
struct Finish {
  explicit Finish(Material wanted);

  Material material;
  std::unique_ptr<const Ggx> lobe;  // where it has a rough one
};

struct Bsdf {
  const Finish* finish;
  Eigen::Vector3f colour;  // with its texture
  Eigen::Vector3f normal;  // shading normal, on the viewer's side
  Eigen::Vector3f view;
  bool inside = false;  // the viewer is in the glass
  // Where a smooth surface mirrors a small part of the light, a sun in it is found by few draws that count much. So what the camera sees is drawn
  // in two halves: what is mirrored, and the rest.
  enum class Half { kBoth, kMirrored, kRest } half = Half::kBoth;

  bool has_halves() const;
  // Light directions that a mirror or glass picks out have no value here, only draw() knows them.
  bool only_picks_directions() const;
  // f(view, light) (normal . light).
  Eigen::Vector3f value(const Eigen::Vector3f& light) const;
  // Of what draw() draws, per steradian.
  float density(const Eigen::Vector3f& light) const;

  struct Draw {
    Eigen::Vector3f light;
    Eigen::Vector3f weight = Eigen::Vector3f::Zero();  // value / density; zero: nothing comes from there
    float density = 0;                                 // 0 for a picked direction
  };
  Draw draw(float choice, const Eigen::Vector2f& random) const;

 private:
  float coat() const;  // share of the light that a plastic's coat mirrors
  float chance_of_coat() const;
  Draw from_lobe(const Eigen::Vector2f& random) const;
  Draw glass(float choice) const;
  Draw base(const Eigen::Vector2f& random) const;
};

// A direction in proportion to its cosine with `normal`; density = cosine / pi.
Eigen::Vector3f draw_cosine(const Eigen::Vector3f& normal, const Eigen::Vector2f& random);

}  // namespace faceprobe::render
