#include "synth/wardrobe/held.h"
#include "synth/wardrobe/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace faceprobe::synth {
namespace {

// Root on the palm (across, along), lengths of the three bones and radius at the root, metres.
struct Finger {
  float across, along;
  std::array<float, 3> bones;
  float radius;
};
constexpr std::array<Finger, 4> kFingers = {{{-0.031F, 0.043F, {0.040F, 0.025F, 0.020F}, 0.0100F},
                                             {-0.011F, 0.048F, {0.044F, 0.029F, 0.021F}, 0.0102F},
                                             {0.010F, 0.046F, {0.041F, 0.027F, 0.021F}, 0.0098F},
                                             {0.029F, 0.038F, {0.033F, 0.020F, 0.018F}, 0.0088F}}};

}  // namespace

void add_hand(const HandPose& pose, float scale, const SkinField* field, MeshBuilder& mesh) {
  const float s = 0.95F * scale;
  const Eigen::Vector3f along = pose.fingers.normalized();
  const Eigen::Vector3f back = (pose.back - along * along.dot(pose.back)).normalized();
  // The thumb's side is the first finger's.
  const Eigen::Vector3f across = (pose.left ? 1.0F : -1.0F) * along.cross(back);
  const auto place = [&](const Eigen::Vector3f& p, float radius) {
    Eigen::Vector3f q = p;
    if (field != nullptr) field->push_out(q, radius);
    return q;
  };
  const auto limb = [&](const std::vector<Eigen::Vector3f>& joints, const std::vector<float>& radii) {
    const std::vector<Eigen::Vector3f> path = smooth_path(joints, 5);
    std::vector<float> thick;
    for (std::size_t i = 0; i < path.size(); ++i) {
      const float at = static_cast<float>(i) / 5.0F;
      const auto k = std::min(static_cast<std::size_t>(at), radii.size() - 2);
      const float t = at - static_cast<float>(k);
      // Knuckles are thicker than what lies between them.
      thick.push_back(((1 - t) * radii[k] + t * radii[k + 1]) * (1.0F - 0.22F * t * (1 - t)));
    }
    mesh.tube(path, thick, 12);
  };
  for (const Finger& finger : kFingers) {
    const float fan = pose.spread * finger.across / 0.03F * 0.35F;
    Eigen::Vector3f direction = (along + fan * across - 0.1F * pose.curl * back).normalized();
    Eigen::Vector3f joint = pose.palm + s * (finger.across * across + (finger.along - 0.022F) * along);
    std::vector<Eigen::Vector3f> joints = {joint};
    joint += 0.022F * s * along;
    joints.push_back(place(joint, finger.radius * s));
    std::vector<float> radii = {finger.radius * s * 1.05F, finger.radius * s};
    float thin = 1.0F;
    for (const float bone : finger.bones) {
      direction = (direction - std::tan(pose.curl) * back).normalized();
      thin *= 0.91F;
      joint = joints.back() + bone * s * direction;
      joints.push_back(place(joint, finger.radius * thin * s));
      radii.push_back(finger.radius * thin * s);
    }
    limb(joints, radii);
  }
  const Eigen::Vector3f thumb_root = pose.palm + s * (-0.022F * across - 0.034F * along - 0.004F * back);
  const Eigen::Vector3f thumb_out = (-0.75F * across + 0.65F * along - 0.25F * back).normalized();
  const Eigen::Vector3f thumb_tip = (-0.25F * across + 0.95F * along - 0.15F * back).normalized();
  const std::vector<Eigen::Vector3f> thumb = {
      thumb_root, place(thumb_root + 0.040F * s * thumb_out, 0.011F * s),
      place(thumb_root + s * (0.040F * thumb_out + 0.030F * thumb_tip), 0.0095F * s),
      place(thumb_root + s * (0.040F * thumb_out + 0.054F * thumb_tip), 0.0085F * s)};
  limb(thumb, {0.014F * s, 0.011F * s, 0.0098F * s, 0.0082F * s});
  Eigen::Matrix3f axes;
  axes << 0.043F * s * across, 0.052F * s * along, 0.0135F * s * back;
  mesh.rounded_box(pose.palm, axes, 2.8F, 7);
  // Wrist and forearm.
  const std::vector<Eigen::Vector3f> arm = {pose.palm - 0.030F * s * along, pose.palm - 0.070F * s * along,
                                            pose.palm - 0.140F * s * along + Eigen::Vector3f(0, -0.01F, 0) * s,
                                            pose.palm - 0.240F * s * along + Eigen::Vector3f(0, -0.04F, 0) * s};
  limb(arm, {0.020F * s, 0.026F * s, 0.032F * s, 0.040F * s});
}

}  // namespace faceprobe::synth
