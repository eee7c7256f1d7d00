#pragma once
// Self-shadowing by horizon mapping (Max 1988, "Horizon mapping: shadows for bump-mapped surfaces"): for each patch and each of
// a few azimuths, the highest thing in the way. The face seen by the camera is the height field, so noses and brows shadow the
// cheeks; what the camera does not see (the back of the head) blocks nothing beyond the surface's own N.L > 0.
//
//   observations.horizon = lighting::horizon_tangents(geometry.position_cam_m, pixels);

#include "faceprobe/core/image.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

// `position_cam_m`: H x W x 3, metres, camera frame, all zeros where there is no surface. `pixels`: #patches x 2, column and row
// of each patch. Returns #patches x kHorizonAzimuths tangents, see Observations::horizon. The same for any
// number of threads. Throws std::invalid_argument for a picture of other than three channels.
Eigen::MatrixXf horizon_tangents(const Image& position_cam_m, const Eigen::MatrixX2i& pixels, int threads = 0);

// `tangents`: one patch's kHorizonAzimuths. Share of a light in a direction (unit, camera frame) that passes the patch's horizon, 0..1, over a soft
// edge of 4 degrees.
float horizon_visibility(const Eigen::Ref<const Eigen::RowVectorXf>& tangents, const Eigen::Vector3f& direction);

}  // namespace faceprobe::lighting
