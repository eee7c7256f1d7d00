#pragma once
// The mannequin's surface as a function of how it looks. Every look has the same vertices and triangles, so the difference of two
// looks is a mode.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace faceprobe::synth {

// All 0 is the mean face, at rest. Identity: about -2 .. 2, 1 = one standard deviation. Expression: 0 .. 1.
struct MannequinLook {
  float face_width = 0, face_length = 0, jaw_width = 0, nose_length = 0, nose_width = 0, brow_ridge = 0,
        lip_fullness = 0, chin = 0;
  float jaw_open = 0, brow_up = 0;
  std::array<float, 2> blink{0, 0}, smile{0, 0};  // the subject's left (+x), right
};

// Places that landmarks, texture and materials refer to; metres, face at rest.
namespace mannequin {
inline constexpr float kEyeX = 0.0315F;  // middles of the eyes; their height is 0
inline constexpr float kEyeHalfWidth = 0.0145F;
inline constexpr float kUpperLid = 0.0058F, kLowerLid = 0.0045F;
inline constexpr float kMouthY = -0.0770F;
inline constexpr float kMouthHalfWidth = 0.0250F;
inline constexpr float kNoseTipY = -0.0430F, kNoseBaseY = -0.0530F;
}  // namespace mannequin

enum class MannequinPart : std::uint8_t { kSkin, kBetweenLips, kEyeball, kTeeth };

struct MannequinGrid {
  Eigen::MatrixX3i triangles;
  std::vector<MannequinPart> part;  // of each triangle
  int skin_vertices = 0;            // come first
};

// The head without features: what takes long to find, and depends on two of the look's numbers only.
struct MannequinBase {
  float face_width = 0, jaw_width = 0;
  std::vector<Eigen::Vector3f> points;
};

MannequinGrid mannequin_grid();
MannequinBase mannequin_base(const MannequinLook& look);
// `base` is of a look with the same face and jaw width.
Eigen::MatrixX3f mannequin_vertices(const MannequinLook& look, const MannequinBase& base);

}  // namespace faceprobe::synth
