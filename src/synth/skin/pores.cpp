#include "faceprobe/synth/skin.h"
#include "synth/skin/noise.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr std::uint32_t kPurpose = 5;

// Two scales of relief; the squared shares of the slope add up to 1. The lattices are turned against each other.
struct Octave {
  float width;  // of the pore size
  float share;
};
constexpr std::array<Octave, 2> kOctaves = {{{1.0F, 0.8F}, {0.47F, 0.6F}}};

// Share of the slope that survives averaging over a pixel: the transfer function of a box about as wide, at the relief's frequency.
float visible_share(float width_m, float footprint_m) {
  const float ratio = footprint_m / width_m;
  return std::exp(-1.6F * ratio * ratio);
}

}  // namespace

PoreNormals pore_normals(const SkinSettings& settings, const Eigen::MatrixX3f& rest_position,
                         const Eigen::MatrixX3f& normal, const Eigen::VectorXf& footprint_m) {
  if (rest_position.rows() != normal.rows() || footprint_m.size() != normal.rows()) {
    throw std::invalid_argument("The arrays of pore normals' points differ in length.");
  }
  PoreNormals out{normal, Eigen::VectorXf::Zero(normal.rows())};
  if (settings.pore_slope <= 0 || settings.pore_size_m <= 0) return out;
  const float axis_slope = settings.pore_slope * 0.70710678F;  // of one of the two tangents
  const std::uint32_t key = noise_key(settings.seed, kPurpose);
  const Eigen::Matrix3f turn =
      (Eigen::AngleAxisf(0.7F, Eigen::Vector3f::UnitZ()) * Eigen::AngleAxisf(0.9F, Eigen::Vector3f::UnitX()))
          .toRotationMatrix();
  const std::array<Eigen::Matrix3f, 2> turns = {turn, turn * turn};
  for (Eigen::Index i = 0; i < normal.rows(); ++i) {
    const Eigen::Vector3f n = normal.row(i).transpose();
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
    float kept = 0;
    for (std::size_t octave = 0; octave < kOctaves.size(); ++octave) {
      const float width_m = kOctaves[octave].width * settings.pore_size_m;
      const float share = kOctaves[octave].share * visible_share(width_m, footprint_m[i]);
      kept += share * share;
      if (share < 0.02F) continue;  // under 1/2500 of the variance
      const Eigen::Vector3f place = turns[octave] * rest_position.row(i).transpose() / width_m;
      gradient += share * (turns[octave].transpose() * noise_gradient(place, key + static_cast<std::uint32_t>(octave)));
    }
    const Eigen::Vector3f slope = axis_slope * (gradient - n.dot(gradient) * n);
    out.normal.row(i) = (n - slope).normalized().transpose();
    out.added_slope_variance[i] = axis_slope * axis_slope * (1.0F - kept);
  }
  return out;
}

}  // namespace faceprobe::synth
