#pragma once
// Which vertices of the canonical mesh lie where. Left and right are the subject's; the right half has canonical x < 0.

#include <array>

namespace faceprobe::face {

inline constexpr int kNoseTipVertex = 4;
inline constexpr int kRightEyeOuterCorner = 33, kRightEyeInnerCorner = 133;
inline constexpr int kLeftEyeInnerCorner = 362, kLeftEyeOuterCorner = 263;
inline constexpr int kRightMouthCorner = 61, kLeftMouthCorner = 291;

// Rings of the right half or across the middle, in order along the curve.
inline constexpr std::array<int, 16> kRightEyeRing = {33,  7,   163, 144, 145, 153, 154, 155,
                                                      133, 173, 157, 158, 159, 160, 161, 246};
inline constexpr std::array<int, 16> kRightEyelidRing = {226, 31,  228, 229, 230, 231, 232, 233,
                                                         244, 189, 221, 222, 223, 224, 225, 113};
inline constexpr std::array<int, 10> kRightBrowRing = {70, 63, 105, 66, 107, 55, 65, 52, 53, 46};
inline constexpr std::array<int, 20> kOuterLipRing = {61,  146, 91,  181, 84,  17, 314, 405, 321, 375,
                                                      291, 409, 270, 269, 267, 0,  37,  39,  40,  185};
inline constexpr std::array<int, 20> kInnerLipRing = {78,  95,  88,  178, 87,  14, 317, 402, 318, 324,
                                                      308, 415, 310, 311, 312, 13, 82,  81,  80,  191};

// Mesh vertices that stand for the 68 iBUG points, 17..67 (brows, nose, eyes, mouth). The jaw line, 0..16, is the
// outline of the head in the picture and not a fixed set of surface points.
inline constexpr int kFirstFixedIbugPoint = 17;
inline constexpr std::array<int, 51> kIbugVertices = {70,  63,  105, 66,  107,                      // right brow
                                                      336, 296, 334, 293, 300,                      // left brow
                                                      168, 197, 5,   4,   75,  97,  2,   326, 305,  // nose
                                                      33,  160, 158, 133, 153, 144,                 // right eye
                                                      362, 385, 387, 263, 373, 380,                 // left eye
                                                      61,  39,  37,  0,   267, 269, 291, 405, 314,
                                                      17,  84,  181,                            // outer lips
                                                      78,  81,  13,  311, 308, 402, 14,  178};  // inner lips

}  // namespace faceprobe::face
