#pragma once
// What a face says about its light as one list of numbers of fixed length, whatever the face's size and turn: the input of what is learnt
// (net/light_prior.h). Shading is gathered by the direction that a patch faces, highlights by the direction that it mirrors, on a coarse grid
// of the whole sphere in the camera frame; where no patch looks there is nothing, and a number says so. Then the light that the
// transport solver finds by itself: deconvolution is hard to learn and easy to compute.
//
//   const Eigen::VectorXf features = lighting::face_features(observations);

#include "faceprobe/lighting/observations.h"

#include <Eigen/Core>

namespace faceprobe::lighting {

inline constexpr int kFeatureNside = 4;                                   // of core/sphere_grid.h
inline constexpr int kFeatureCells = 12 * kFeatureNside * kFeatureNside;  // 192
inline constexpr int kGatheredLayers = 3;                                 // shading, highlights, open shading
inline constexpr int kCellFeatures = kGatheredLayers * kFeatureCells * 4;
inline constexpr int kSolvedLights = 2;  // from the shading, from the open shading
inline constexpr int kSolvedFeatures = kSolvedLights * 3 * kFeatureCells;
inline constexpr int kFaceFeatures = kCellFeatures + kSolvedFeatures;  // 3456
// What highlights are multiplied by: they are weaker than shading, and this brings both to one size.
inline constexpr float kHighlightScale = 3.0F;

// Mean luminance of the shading over patches that are not clipped, by weight: the unit of features and of the light that is learnt. 0 without
// such patches.
float shading_level(const Observations& observations);

// kFaceFeatures numbers: for each cell the square roots of red, green and blue of the shading over its level, and how well they are known,
// 0 to 1; then the same of the highlights times kHighlightScale; then of each cell the square roots of red, green and blue of the
// light over the level that the transport solver finds by itself, without shadows. All zero where the level is 0. Throws std::invalid_argument for observations that do not validate.
Eigen::VectorXf face_features(const Observations& observations);

// The features of the mirror image, left and right changed places. Throws std::invalid_argument for another length.
Eigen::VectorXf mirrored_features(const Eigen::VectorXf& features);
// kFeatureCells x anything: the rows of the mirror image. Throws std::invalid_argument for another number of rows.
Eigen::MatrixXf mirrored_cells(const Eigen::MatrixXf& cells);

}  // namespace faceprobe::lighting
