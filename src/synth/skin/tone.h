#pragma once
// How the colour of skin moves with its two pigments, around a given tone.

#include <Eigen/Core>

namespace faceprobe::synth {

inline constexpr float kTypicalBlood = 0.03F;  // haemoglobin of skin that nothing more is known about
inline constexpr float kMinMelanin = 0.005F;
inline constexpr float kMaxMelanin = 0.43F;

// Melanin that gives this luminance with typical blood, within the human range.
float melanin_of(const Eigen::Vector3f& tone);

// Directions in log(linear RGB), unit length, towards more pigment: darker in every channel.
struct PigmentAxes {
  Eigen::Vector3f melanin;
  Eigen::Vector3f haemoglobin;
};
// Those of medium skin: the two are told apart best there.
const PigmentAxes& pigment_axes();

// Change of log albedo (length of the vector) when blood doubles: large in light skin, next to nothing under much melanin.
float redness_response(const Eigen::Vector3f& tone);

}  // namespace faceprobe::synth
