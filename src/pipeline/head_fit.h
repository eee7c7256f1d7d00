#pragma once
// A head model's shape and pose that put its landmarks where a photo has them.

#include "faceprobe/face/face.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/synth/head_model.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace faceprobe::pipeline {

// Landmarks of the model that the dense face mesh has too: all 468, else the 51 fixed ones of the 68.
struct LandmarkPairs {
  std::vector<synth::SurfacePoint> model;
  std::vector<int> mesh;  // vertex of the dense mesh
  bool dense = false;
};
// Throws Error(kModel) when the model has neither kind.
LandmarkPairs landmark_pairs(const synth::HeadModel& model);

struct HeadFit {
  Eigen::MatrixX3f vertices_cam;  // #V x 3, metres, camera frame
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
  Eigen::VectorXf identity;
  Eigen::VectorXf expression;
  Eigen::MatrixX2f landmarks_px;  // of the pairs, as fitted
  double residual_px = 0;         // rms
};
// Gauss-Newton on pose, identity (ridge: one standard deviation) and expression. Starts at the pose of `face`.
HeadFit fit_head(const synth::HeadModel& model, const LandmarkPairs& pairs, const face::Face& face,
                 const face::Camera& camera);

// All of the fitted model's vertices as a picture shows them: crop pixels and depth (metres, positive), bent so that its landmarks lie
// where the photo has them, which no model's modes reach to the pixel.
Eigen::MatrixX3f picture_points(const HeadFit& fit, const LandmarkPairs& pairs, const face::Face& face,
                                const face::Camera& camera, const face::Crop& crop, int threads);

// A point of a surface from its vertices.
inline Eigen::Vector3f surface_point(const Eigen::MatrixX3f& vertices, const Eigen::MatrixX3i& triangles,
                                     const synth::SurfacePoint& at) {
  return (at.weights.transpose() * vertices(triangles.row(at.triangle), Eigen::all)).transpose();
}

}  // namespace faceprobe::pipeline
