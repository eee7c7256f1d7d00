#pragma once
// A parametric head: a neutral shape, identity modes of one standard deviation each, expressions of weight 0 .. 1, and what the
// generator has to know about its parts. Loaders for real models are in assets/; procedural_head.h makes a small one of our own.
//
// Head frame: metres, +x the subject's left (the right of a frontal photo), +y up, +z out of the face, origin midway between the eyes.
//
//   const HeadModel model = procedural_head();
//   HeadParameters parameters = draw_head(model, random);
//   const Head head = make_head(model, parameters);

#include "faceprobe/core/image.h"
#include "faceprobe/core/random.h"
#include "faceprobe/synth/mesh.h"

#include <string>
#include <vector>

namespace faceprobe::synth {

// A point of the surface that moves with it.
struct SurfacePoint {
  int triangle = 0;
  Eigen::Vector3f weights = Eigen::Vector3f::Zero();  // barycentric, sum 1
};

// Which textures fit a model's UVs.
enum class UvLayout : std::uint8_t { kNone, kIctFace, kOwn };

struct HeadModel {
  std::string name;
  Eigen::MatrixX3f neutral;                  // #V x 3, metres
  std::vector<Eigen::MatrixX3f> identity;    // each n x 3 with n <= #V: offsets of the first n vertices
  std::vector<Eigen::MatrixX3f> expression;  // the same
  std::vector<std::string> expression_names;  // may be empty: then expressions are statistics, one standard deviation each
  Eigen::MatrixX3i triangles;                 // #T x 3
  std::vector<Material> triangle_material;  // #T: kSkin, kEye, kMouth or kTeeth
  Eigen::MatrixX2f uv;                      // #UV x 2, v up; may be empty
  Eigen::MatrixX3i triangle_uv;             // #T x 3; empty when uv is
  UvLayout uv_layout = UvLayout::kNone;
  std::vector<Region> vertex_region;           // #V
  std::vector<int> landmarks;                  // 68 vertices, Multi-PIE order; may be empty
  std::vector<SurfacePoint> dense_landmarks;   // 468, the dense face mesh's order; may be empty
  ByteImage texture;                           // sRGB, for kOwn; may be empty
  Eigen::MatrixX3f vertex_albedo;              // #V x 3 linear mean; may be empty
  std::vector<Eigen::MatrixX3f> albedo_modes;  // #V x 3 each, one standard deviation; may be empty

  // Empty when the arrays fit together and hold only finite numbers, else a sentence that says what does not.
  std::string validate() const;
};

struct HeadParameters {
  Eigen::VectorXf identity;    // standard deviations
  Eigen::VectorXf expression;  // 0 .. 1; standard deviations where they have no names
  Eigen::VectorXf albedo;      // standard deviations; empty without albedo modes
};

struct HeadDraw {
  float identity_deviation = 1.0F;  // of the normal distribution that identity is drawn from
  float neutral_share = 0.4F;       // of the heads with no expression at all
};

// identity ~ N(0, 1); now and then an expression out of few combinations that faces make (smile, open mouth, closed eyes, raised
// or knitted brows, puckered lips, eyes that look aside), by name (ICT-FaceKit's or ARKit's) where the model names them. Expressions
// without names are drawn from a normal distribution.
HeadParameters draw_identity(const HeadModel& model, const HeadDraw& options, Random& random);
Eigen::VectorXf draw_expression(const HeadModel& model, const HeadDraw& options, Random& random);

// One mesh per material that the model has, in the head frame: skin, eyes, mouth, teeth. Normals belong to the whole deformed head, so
// neither seams of the texture nor borders of its parts show a crease. Fewer weights than modes: the rest is 0; more:
// std::invalid_argument.
struct Head {
  Figure figure;
  Eigen::MatrixX3f landmarks;        // 68 x 3 or empty
  Eigen::MatrixX3f dense_landmarks;  // 468 x 3 or empty
};
// Head frame, metres.
Head make_head(const HeadModel& model, const HeadParameters& parameters);

}  // namespace faceprobe::synth
