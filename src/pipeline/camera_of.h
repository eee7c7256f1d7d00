#pragma once
// The camera a photo was taken with, as far as the photo says.

#include "faceprobe/pipeline/estimate.h"

#include <cmath>

namespace faceprobe::pipeline {

struct CameraChoice {
  face::Camera camera;
  FocalSource source = FocalSource::kDefault;
};

inline CameraChoice camera_of(const io::Photo& photo, const EstimateOptions& options) {
  CameraChoice choice;
  choice.camera.centre_x_px = 0.5 * photo.linear.width();
  choice.camera.centre_y_px = 0.5 * photo.linear.height();
  if (options.focal_px) {
    choice.camera.focal_px = *options.focal_px;
    choice.source = FocalSource::kGiven;
  } else if (photo.focal_px) {
    choice.camera.focal_px = *photo.focal_px;
    choice.source = FocalSource::kExif;
  } else {
    constexpr double kLensMm = 50;
    choice.camera.focal_px = kLensMm / io::kFilmDiagonalMm * std::hypot(photo.linear.width(), photo.linear.height());
  }
  return choice;
}

}  // namespace faceprobe::pipeline
