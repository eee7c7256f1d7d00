#pragma once
// A face with everything known: the canonical mesh in a known pose, lit by distant lamps and an even sky through the shading model
// itself, with shadows by tracing rays to the mesh's triangles. Independent of the transport matrices and horizons under test.

#include "faceprobe/core/image.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/separate.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::pipeline::testing {

struct PosedFace {
  face::Face face;
  face::FaceGeometry geometry;
};

// A head 0.6 m in front of the camera, turned to the photo's right by yaw_deg; about 190 px wide in the crop.
PosedFace posed_face(double yaw_deg);

struct Lamp {
  Eigen::Vector3d direction;                             // unit, camera frame, from the face
  Eigen::Vector3f irradiance = Eigen::Vector3f::Ones();  // on a surface that faces it
};

// What each pixel of the crop mirrors and what it receives.
struct LitFace {
  Image highlight;
  Image shading;  // irradiance / pi
};
LitFace light_up(const PosedFace& posed, const std::vector<Lamp>& lamps, float ambient_radiance);

// The photo of it: albedo x shading + highlight, with one colour for lips and one for all other skin; black off the face.
Image photograph(const PosedFace& posed, const LitFace& lit);

// Direction that the energy of a light points to on the whole.
Eigen::Vector3d energy_centroid(const Eigen::MatrixX3f& radiance, const Eigen::MatrixX3f& directions);

}  // namespace faceprobe::pipeline::testing
