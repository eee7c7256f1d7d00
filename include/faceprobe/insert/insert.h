#pragma once
// A virtual thing into a photo, in the photo's own light (the paper's object insertion; differential rendering of Debevec 1998): drawn by the path
// tracer, its shadow laid on what is there, softened and grained as the photo is.
//
//   insert::Scene scene{.view = pipeline::view_of(estimate), .environment = face.environment, .model = render::shape("pot")};
//   render::place(scene.model, {.height_m = 0.2F, .foot_m = {0.2F, -0.25F, -0.7F}});
//   const insert::Insertion done = insert::insert_model(photo.linear, scene, {});
//   io::write_picture("with_pot.png", done.picture);
//
// The map's radiance must be in the photo's unit, as an estimate's is. Shadows are factors on the photo, so what is dark there already stays; the
// thing casts none on people, and people none on it. Not for video.

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/core/pixel_box.h"
#include "faceprobe/insert/photo_look.h"
#include "faceprobe/render/path_tracer.h"

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::insert {

// What of the photo stands in front of far things.
struct Matte {
  Image cover;    // the photo's size, one channel, 0..1: 1 where a person is
  Image depth_m;  // the same: how far away along -z; of no matter where cover is 0
};

struct Scene {
  render::PinholeView view;  // of the whole photo
  EnvMap environment;        // camera frame, in the photo's unit
  std::vector<render::BallLamp> lamps{};
  render::Model model;                             // placed, camera frame, metres
  bool ground = true;                              // whether it stands on something that takes its shadow
  Eigen::Vector3f up = Eigen::Vector3f::UnitY();   // unit, of the ground, which touches the model's lowest point
  std::optional<Eigen::Vector3f> ground_albedo{};  // else from the photo's colour where the model stands
  std::optional<Matte> matte{};
};

struct Options {
  render::RenderOptions render{.samples = 256, .noise = 0.03F, .clamp_indirect = 8};
  bool match_blur = true;  // of the photo's sharpest edges
  bool match_grain = true;

  std::string validate() const;
};

struct Insertion {
  Image picture;                                            // the photo with the thing in it, linear
  PixelBox box;                                             // of the photo, what was drawn
  render::Layers layers;                                    // in the box
  Eigen::Vector3f ground_albedo = Eigen::Vector3f::Zero();  // linear; what was taken, 0 without a ground
  float blur_px = 0;                                        // what the layers were softened by
  Grain grain;                                              // what was added
  bool stopped = false;                                     // options.render.progress said so
};

// Throws std::invalid_argument for a photo that is not view.width_px x height_px x 3, for options or a model that do not validate, and for a
// matte of another size;
// Error(kUsage) when no part of the thing is in the picture.
Insertion insert_model(const Image& photo, const Scene& scene, const Options& options = {});

// The same at a smaller size, for a quick look: the photo's longer side becomes `long_side_px`. Nothing happens to a photo that is no larger,
// and for a side that is not above 0.
void shrink(Image& photo, Scene& scene, int long_side_px);

}  // namespace faceprobe::insert
