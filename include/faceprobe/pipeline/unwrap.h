#pragma once
// Makes a skin texture in a head model's UVs from a photo of a face: the model is fitted to the face's landmarks, the photo is read off
// its surface, highlights and slow shading are taken out, what the camera did not see is filled from the other half and from around.
//
//   const Unwrapped skin = unwrap(io::load_photo("portrait.jpg"), model, finder);
//   io::write_picture("skin.png", skin.texture);
//
// Real: the front of the face with brows, lips, stubble, make-up. Filled: sides, ears, neck, eyes, inside of the mouth. Left in: hard
// shadows and what of broad highlights the separator leaves. The level is the photo's exposure, not absolute reflectance.

#include "faceprobe/face/face.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/synth/head_model.h"

#include <optional>
#include <string>

namespace faceprobe::pipeline {

struct UnwrapOptions {
  int size_px = 512;        // of the square texture, 16 .. 4096
  double max_yaw_deg = 35;  // a face turned further shows too little of one half
  highlight::Separator separator = highlight::Separator::kYang;
  std::optional<double> focal_px;  // as EstimateOptions::focal_px
  int threads = 0;

  std::string validate() const;  // empty when usable
};

struct UnwrapReport {
  double residual_px = 0;  // rms distance of the fitted model's landmarks from the photo's, before the warp takes it out
  double face_width_px = 0;  // of the landmarks in the photo
  double yaw_deg = 0;
  double pitch_deg = 0;
  double covered = 0;        // mean of `coverage` over the texels that are skin near the landmarks
  double shading_taken = 0;  // standard deviation of the log shading that was divided out
};

struct Unwrapped {
  ByteImage texture;  // size_px x size_px x 3, sRGB, row 0 is v = 1
  Image coverage;     // size_px x size_px x 1: 1 = read from the photo, 0 = filled
  UnwrapReport report;
};

// Of the largest face. Throws Error: options not usable (kUsage); no face, or a profile (kNoFace); a model without UVs, landmarks or
// skin (kModel).
Unwrapped unwrap(const io::Photo& photo, const synth::HeadModel& model, const face::FaceFinder& finder,
                 const UnwrapOptions& options = {});
// Of a face that has been found.
Unwrapped unwrap_face(const io::Photo& photo, const face::Face& face, const face::Camera& camera,
                      const synth::HeadModel& model, const UnwrapOptions& options = {});

}  // namespace faceprobe::pipeline
