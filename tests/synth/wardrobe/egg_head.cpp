#include "synth/wardrobe/egg_head.h"

#include "faceprobe/core/vertex_normals.h"

#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr float kPi_ = 3.14159265F;

void append(SurfaceMesh& mesh, const std::vector<Eigen::Vector3f>& points, int columns) {
  const auto first = static_cast<int>(mesh.vertices.rows());
  const auto rows = static_cast<int>(points.size()) / columns;
  mesh.vertices.conservativeResize(first + static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.vertices.row(first + static_cast<Eigen::Index>(i)) = points[i].transpose();
  Eigen::Index t = mesh.triangles.rows();
  mesh.triangles.conservativeResize(t + 2 * (rows - 1) * columns, 3);
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int a = first + r * columns + c;
      const int b = first + r * columns + (c + 1) % columns;
      mesh.triangles.row(t++) << a, b, b + columns;
      mesh.triangles.row(t++) << a, b + columns, a + columns;
    }
  }
}

// On the egg's front at (x, y).
Eigen::Vector3f front(float x, float y, float out = 0) {
  const float a = x / kEggRadii.x();
  const float b = y / kEggRadii.y();
  return {x, y, kEggCentre.z() + kEggRadii.z() * std::sqrt(std::max(0.0F, 1.0F - a * a - b * b)) + out};
}

Eigen::MatrixX3f landmarks_of_egg() {
  std::vector<Eigen::Vector3f> p;
  for (int i = 0; i < 17; ++i) {  // jaw, right to left
    const float angle = kPi_ * static_cast<float>(i) / 16.0F;
    p.push_back(front(-0.072F * std::cos(angle), -0.1F * std::sin(angle)));
  }
  for (int i = 0; i < 10; ++i) {  // brows
    static constexpr std::array<float, 10> kX = {-0.056F, -0.048F, -0.037F, -0.024F, -0.012F,
                                                 0.012F,  0.024F,  0.037F,  0.048F,  0.056F};
    p.push_back(front(kX[static_cast<std::size_t>(i)], 0.024F));
  }
  for (int i = 0; i < 4; ++i)
    p.push_back(front(0, -0.010F * static_cast<float>(i), 0.004F + 0.006F * static_cast<float>(i)));
  for (int i = 0; i < 5; ++i) p.push_back(front(-0.012F + 0.006F * static_cast<float>(i), -0.045F, 0.006F));
  for (const float side : {-1.0F, 1.0F}) {
    static constexpr std::array<std::array<float, 2>, 6> kEye = {
        {{0.044F, 0}, {0.037F, 0.005F}, {0.027F, 0.005F}, {0.018F, 0}, {0.027F, -0.004F}, {0.037F, -0.004F}}};
    static constexpr std::array<int, 6> kLeftOrder = {3, 2, 1, 0, 5, 4};
    for (int i = 0; i < 6; ++i) {
      const auto& e = kEye[static_cast<std::size_t>(side < 0 ? i : kLeftOrder[static_cast<std::size_t>(i)])];
      p.push_back(front(side * e[0], e[1]));
    }
  }
  static constexpr std::array<std::array<float, 2>, 20> kMouth = {
      {{-0.025F, -0.068F}, {-0.016F, -0.062F}, {-0.007F, -0.059F}, {0, -0.06F},       {0.007F, -0.059F},
       {0.016F, -0.062F},  {0.025F, -0.068F},  {0.016F, -0.075F},  {0.007F, -0.078F}, {0, -0.079F},
       {-0.007F, -0.078F}, {-0.016F, -0.075F}, {-0.022F, -0.068F}, {-0.01F, -0.067F}, {0, -0.067F},
       {0.01F, -0.067F},   {0.022F, -0.068F},  {0.01F, -0.069F},   {0, -0.069F},      {-0.01F, -0.069F}}};
  for (const auto& m : kMouth) p.push_back(front(m[0], m[1]));
  Eigen::MatrixX3f points(68, 3);
  for (int i = 0; i < 68; ++i) points.row(i) = p[static_cast<std::size_t>(i)].transpose();
  return points;
}

}  // namespace

Head egg_head(bool landmarks) {
  SurfaceMesh skin;
  skin.material = Material::kSkin;
  skin.vertices.resize(0, 3);
  skin.triangles.resize(0, 3);
  constexpr int kAround = 72;
  std::vector<Eigen::Vector3f> points;
  for (int r = 0; r <= 48; ++r) {
    const float polar = kPi_ * (1.0F - std::clamp(static_cast<float>(r) / 48.0F, 0.005F, 0.995F));
    for (int c = 0; c < kAround; ++c) {
      const float azimuth = 2 * kPi_ * static_cast<float>(c) / kAround;
      points.push_back(kEggCentre +
                       kEggRadii.cwiseProduct(Eigen::Vector3f(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                                              std::sin(polar) * std::cos(azimuth))));
    }
  }
  append(skin, points, kAround);
  points.clear();
  for (int r = 0; r <= 10; ++r) {  // up to where it enters the egg
    for (int c = 0; c < kAround; ++c) {
      const float azimuth = 2 * kPi_ * static_cast<float>(c) / kAround;
      points.emplace_back(0.055F * std::sin(azimuth), -0.19F + 0.01F * static_cast<float>(r),
                          -0.095F + 0.055F * std::cos(azimuth));
    }
  }
  append(skin, points, kAround);
  skin.normals = vertex_normals(skin.vertices, skin.triangles);
  skin.vertex_region.assign(static_cast<std::size_t>(skin.vertices.rows()), Region::kOther);
  Head head;
  head.figure.meshes.push_back(std::move(skin));
  if (landmarks) head.landmarks = landmarks_of_egg();
  return head;
}

float egg_level(const Eigen::Vector3f& p) { return (p - kEggCentre).cwiseQuotient(kEggRadii).norm(); }

}  // namespace faceprobe::synth
