#pragma once
// A thing into a photo by what was estimated of it: the light of the nearest face, the camera, which way is up, who stands in front.
//
//   const pipeline::Estimate estimate = estimator.estimate(photo);
//   const insert::Scene scene = pipeline::scene_for(photo, estimate, render::shape("pot"), {.height_m = 0.15F});
//   const insert::Insertion done = insert::insert_model(photo.linear, scene);
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
  std::optional<float> depth_m{};      // of the foot along the camera's axis; else three quarters of the largest face's
  std::optional<float> height_m{};     // else so that its longer side takes a third of the picture's shorter one
  float turn_deg = 0;                  // about its own axis; positive turns its front to the right of the photo
  std::optional<double> horizon_px{};  // height of the horizon in the photo; else up is told by the heads
  bool ground = true;                  // whether it stands on something that takes its shadow
  lighting::MainLightOptions main_lights{};  // those of the estimate
  Image matte{};  // the photo's size, one channel: people in front of far things; empty = the faces' crops tell

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

// A matte from a picture of one, white where a person stands; its greys are shares, not light.
Image matte_from(const io::Photo& picture);

// The photo as a view for renderers.
render::PinholeView view_of(const Estimate& estimate);

// Throws Error(kUsage) for options that do not validate or a matte of another size.
insert::Scene scene_for(const io::Photo& photo, const Estimate& estimate, render::Model model,
                        const InsertionOptions& options = {});

}  // namespace faceprobe::pipeline
