#include "support/square.h"

namespace faceprobe::bench {

train::Warp warp_of(const pipeline::FaceEstimate& estimate, const train::FaceTemplate& square) {
  const face::Crop& crop = estimate.geometry.crop;
  train::WarpLandmarks landmarks{estimate.face.landmarks_px.leftCols<2>(), estimate.face.landmarks_px.col(2)};
  for (Eigen::Index i = 0; i < landmarks.photo_px.rows(); ++i) {
    const Eigen::Vector2d at = crop.crop_from_photo(static_cast<double>(landmarks.photo_px(i, 0)),
                                                    static_cast<double>(landmarks.photo_px(i, 1)));
    landmarks.photo_px.row(i) = at.cast<float>().transpose();
  }
  landmarks.depth_px *= static_cast<float>(crop.scale);
  return train::face_warp(square, landmarks, {crop.width, crop.height});
}

}  // namespace faceprobe::bench
