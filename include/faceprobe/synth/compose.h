#pragma once
// From light on fragments to the layers of a picture: colour of every surface, subsurface blur, bounce, exposure, background, camera.
//
//   ViewSurface surface = empty_surface(transport, fragments);
//   add_person_surface(assets, person, person.skins[0], scene, transport, fragments, surface);
//   const Sample sample = compose(view_transport, surface, light, background, settings, random);

#include "faceprobe/synth/person.h"
#include "faceprobe/synth/sample.h"
#include "faceprobe/synth/transport.h"

#include <span>

namespace faceprobe::synth {

// What multiplies light, per fragment, in one skin.
struct ViewSurface {
  Eigen::MatrixX3f albedo;          // #F x 3
  Eigen::VectorXf specular_albedo;  // #F, rho_s
  Eigen::MatrixX3f row_albedo;      // #rows of the scene transport x 3, for the bounce
};
// Black fragments of no lobe, and vertices of albedo .3 for whatever no person owns.
ViewSurface empty_surface(const SceneTransport& transport, const Fragments& fragments);
// Fills in what is the person's; several people share one surface.
void add_person_surface(const Assets& assets, const Person& person, const SkinSettings& skin, const Scene& scene,
                        const SceneTransport& transport, const Fragments& fragments, ViewSurface& surface);

// Shape of the lobes: roughness and pores of the first skin, the materials' own elsewhere.
FragmentSurface plain_lobes(const Fragments& fragments);
void add_person_lobes(const Person& person, const Fragments& fragments, const PinholeCamera& camera,
                      FragmentSurface& surface);

// Geometry layers of a view of these people.
ViewLayers view_layers(std::span<const Person> people, const View& view, const Fragments& fragments);

// Light mixed within the skin: shading (#F x 3) of skin fragments blurred over the picture, by channel, as far as light
// scatters (mean free paths after Jensen et al. 2001: red farthest). Other materials keep theirs.
void scatter_below_surface(const Fragments& fragments, const PinholeCamera& camera, Eigen::MatrixX3f& shading);

// Linear layers of one sample, exposed by `gain`; `background`, already exposed, is seen where fragments leave room.
struct LinearLayers {
  Image highlight, diffuse, albedo, shading;  // the view's size, 3 channels, as Sample's
};
// `shading`: #F x 3, with what bounces; `specular`: #F x 3, of rho_s = 1. `background`: the view's size, 3 channels.
LinearLayers gather_layers(const Fragments& fragments, const ViewSurface& surface, const Eigen::MatrixX3f& shading,
                           const Eigen::MatrixX3f& specular, const Image& background, const Eigen::Vector3f& gain);

}  // namespace faceprobe::synth
