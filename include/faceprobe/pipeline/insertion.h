#pragma once
// A thing into a photo by what was estimated of it: the light of the nearest face, the camera, which way is up, who stands in front.
//
//   const pipeline::Estimate estimate = estimator.estimate(photo);
//   const insert::Scene scene = pipeline::scene_for(photo, estimate, render::shape("pot"), {.height_m = 0.15F});
//   const insert::Insertion done = insert::insert_model(photo.linear, scene);
//
// Where several faces tell where lamps stand (room.h), these are lamps of the scene, and out of its map.
//
// Unless told otherwise the thing stands in the lower corner with more room, nearer than the largest face. People are known only as far as the
// faces' crops go: a thing behind a shoulder needs a matte.

#include "faceprobe/insert/insert.h"
#include "faceprobe/pipeline/estimate.h"

#include <Eigen/Core>
#include <optional>
#include <string>

namespace faceprobe::pipeline {

struct InsertionOptions {
  std::optional<Eigen::Vector2d> at_px{};  // pixel of the photo where the thing's foot is seen
  // Of the foot to the right of the face's middle, below 0 to its left, metres along the photo's rows; low in the picture, as deep as the face
  // unless depth_m says otherwise. Of `face`, else of the largest one; not with at_px.
  std::optional<float> beside_m{};
  std::optional<float> depth_m{};      // of the foot along the camera's axis; else three quarters of the largest face's
  std::optional<float> height_m{};     // else so that its longer side takes .35 of the picture's shorter one
  float turn_deg = 0;                  // about its own axis; positive turns its front to the right of the photo
  std::optional<double> horizon_px{};  // height of the horizon in the photo; else up is told by the heads
  bool ground = true;                  // whether it stands on something that takes its shadow
  std::optional<int> face{};  // of the estimate, in whose light the thing stands; else the face that is nearest to it
  bool joint_light =
      false;  // in the one light of all faces, where there are several; `face` is of no matter for the light then
  lighting::MainLightOptions main_lights{};  // those of the estimate
  Image matte{};  // the photo's size, one channel: people in front of far things; empty = the faces' crops tell

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// A matte from a picture of one, white where a person stands; its greys are shares, not light. H x W x 1, 0..1.
Image matte_from(const io::Photo& picture);

// The photo as a view for renderers.
render::PinholeView view_of(const Estimate& estimate);

// Which way is up in the camera's frame, a unit vector: told by the horizon if there is one, else by the heads.
Eigen::Vector3f up_in(const Estimate& estimate, const InsertionOptions& options = {});

// Where a thing stands: what the options say, and for what they leave open the lower corner with more room.
struct Spot {
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();  // of the photo, where the foot is seen
  float depth_m = 0;                                // of the foot along the camera's axis
  float height_m = 0;                               // of the thing
};
// `model`: at any size and place; only its shape counts.
Spot spot_for(const Estimate& estimate, const render::Model& model, const InsertionOptions& options = {});

// Throws Error(kUsage) for options that do not validate or a matte of another size, Error(kInput) for a model without height.
insert::Scene scene_for(const io::Photo& photo, const Estimate& estimate, render::Model model,
                        const InsertionOptions& options = {});

}  // namespace faceprobe::pipeline
