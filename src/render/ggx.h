#pragma once
// The GGX lobe of rough mirrors (Walter et al. 2007) with Smith's height-correlated shadowing (Heitz 2014), its visible normals drawn as in Heitz 2018,
// and what single scattering loses given back: half of it by a factor on the lobe (Turquin 2019), half spread wide (Kulla & Conty 2017). Against a
// random walk on the facets (Heitz et al. 2016) the one is too narrow and the other too wide. All vectors in the surface's frame, z = normal.

#include <Eigen/Core>
#include <array>

namespace faceprobe::render {

class Ggx {
 public:
  explicit Ggx(float alpha);

  // f(view, light) |light.z|, per steradian, for a mirror that reflects everything; 0 below the surface. Adds up to 1 over the lights.
  float value(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  // The same of light that one facet alone has mirrored, which is less.
  float single(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  // Per steradian of light, as draw() draws.
  float density(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  // A direction of light; may lie below the surface, where value() is 0.
  Eigen::Vector3f draw(const Eigen::Vector3f& view, const Eigen::Vector2f& random) const;
  // Share of the light that one scattering returns, by cosine of the viewer's angle.
  float directional_albedo(float cosine) const;

 private:
  float lambda(float cosine) const;
  float distribution(const Eigen::Vector3f& half) const;  // D of the microfacets' normals
  float wide_chance(float cosine) const;
  float facet_density(const Eigen::Vector3f& view, const Eigen::Vector3f& light) const;
  Eigen::Vector3f draw_facet(const Eigen::Vector3f& view, const Eigen::Vector2f& random) const;

  static constexpr int kAngles = 32;
  float alpha2_;
  float alpha_;
  std::array<float, kAngles> directional_albedo_{};
  float mean_albedo_ = 0;  // over the angles, weighed by their cosines
};

// Exact Fresnel reflectance of a dielectric for unpolarised light; `eta`: index of refraction of the far side over the near one's. 1 where nothing
// passes.
float dielectric_fresnel(float cosine, float eta);

}  // namespace faceprobe::render
