#include "synth/wardrobe/anatomy.h"

#include "faceprobe/core/vertex_normals.h"

#include <algorithm>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

SurfaceMesh all_skin(const Head& head) {
  SurfaceMesh all;
  for (const SurfaceMesh& mesh : head.figure.meshes) {
    if (mesh.material != Material::kSkin) continue;
    const Eigen::Index vertices = all.vertices.rows();
    const Eigen::Index triangles = all.triangles.rows();
    all.vertices.conservativeResize(vertices + mesh.vertices.rows(), 3);
    all.vertices.bottomRows(mesh.vertices.rows()) = mesh.vertices;
    all.triangles.conservativeResize(triangles + mesh.triangles.rows(), 3);
    all.triangles.bottomRows(mesh.triangles.rows()) = mesh.triangles.array() + static_cast<int>(vertices);
  }
  if (all.triangles.rows() == 0) throw std::invalid_argument("A head to dress must have a mesh of skin.");
  all.normals = vertex_normals(all.vertices, all.triangles);
  return all;
}

// An average adult's 68 points, for heads that come without; millimetres, right half (x < 0) and middle line, mirrored below.
Eigen::MatrixX3f average_landmarks() {
  static constexpr float kHalf[][4] = {
      // index, x, y, z
      {0, -74, 2, -56},   {1, -73, -20, -53}, {2, -69, -39, -47}, {3, -66, -58, -40}, {4, -57, -79, -31},
      {5, -43, -97, -19}, {6, -30, -104, -4}, {7, -15, -107, 10}, {8, 0, -110, 12},   {17, -58, 18, -13},
      {18, -49, 25, -2},  {19, -38, 28, 6},   {20, -24, 28, 13},  {21, -12, 25, 15},  {27, 0, 3, 15},
      {28, 0, -8, 23},    {29, 0, -18, 31},   {30, 0, -30, 38},   {31, -12, -46, 17}, {32, -6, -46, 22},
      {33, 0, -46, 23},   {36, -45, 0, -6},   {37, -39, 4, 1},    {38, -28, 5, 3},    {39, -18, -2, 0},
      {40, -27, -4, 2},   {41, -39, -4, 0},   {48, -25, -70, 10}, {49, -17, -62, 20}, {50, -7, -59, 25},
      {51, 0, -59, 26},   {57, 0, -78, 23},   {58, -10, -77, 22}, {59, -18, -75, 17}, {60, -22, -69, 9},
      {61, -10, -67, 19}, {62, 0, -68, 21},   {66, 0, -68, 20},   {67, -11, -68, 18}};
  static constexpr int kMirror[][2] = {{0, 16},  {1, 15},  {2, 14},  {3, 13},  {4, 12},  {5, 11},  {6, 10},  {7, 9},
                                       {17, 26}, {18, 25}, {19, 24}, {20, 23}, {21, 22}, {31, 35}, {32, 34}, {36, 45},
                                       {37, 44}, {38, 43}, {39, 42}, {40, 47}, {41, 46}, {48, 54}, {49, 53}, {50, 52},
                                       {58, 56}, {59, 55}, {60, 64}, {61, 63}, {67, 65}};
  Eigen::MatrixX3f points(68, 3);
  for (const auto& p : kHalf) points.row(static_cast<int>(p[0])) << p[1], p[2], p[3];
  for (const auto& pair : kMirror) points.row(pair[1]) = points.row(pair[0]).cwiseProduct(Eigen::RowVector3f(-1, 1, 1));
  return points * 1e-3F;
}

// The eyes lie at the origin of the head frame, so only a size is missing: the top of a head is 0.11 m above them.
Eigen::MatrixX3f guessed_landmarks(const SurfaceMesh& skin) {
  const float top = skin.vertices.col(1).maxCoeff();
  return average_landmarks() * std::clamp(top / 0.112F, 0.3F, 3.0F);
}

struct Extent {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(1e9F);
  Eigen::Vector3f high = Eigen::Vector3f::Constant(-1e9F);
  int count = 0;
  void add(const Eigen::Vector3f& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    ++count;
  }
};

}  // namespace

Anatomy measure(const Head& head) {
  Anatomy a;
  a.skin = all_skin(head);
  a.landmarks = head.landmarks.rows() == 68 ? head.landmarks : guessed_landmarks(a.skin);
  const float eyes = (a.landmark_mean(42, 6) - a.landmark_mean(36, 6)).norm();
  const float height = a.brow_y() - a.landmark_mean(31, 5).y();  // brows to nose base: the jaw may be open
  a.scale = std::clamp(0.5F * eyes / 0.0635F + 0.5F * height / 0.0707F, 0.3F, 3.0F);
  const float s = a.scale;

  Extent skull;
  Extent neck;
  const float brow = a.brow_y();
  const float chin = a.landmark(8).y();
  for (const auto& row : a.skin.vertices.rowwise()) {
    const Eigen::Vector3f p = row.transpose();
    if (p.y() > brow) skull.add(p);
    if (p.y() < chin - 0.005F * s && p.y() > chin - 0.03F * s && p.z() < a.landmark(8).z() - 0.03F * s) neck.add(p);
  }
  if (skull.count < 3) {
    skull.add(Eigen::Vector3f(-0.078F, brow, -0.175F) * s);
    skull.add(Eigen::Vector3f(0.078F, 0.112F, 0.012F) * s);
  }
  a.skull_centre = 0.5F * (skull.low + skull.high);
  a.skull_centre.y() = brow;
  a.skull_radii = 0.5F * (skull.high - skull.low);
  a.skull_radii.y() = skull.high.y() - brow;
  if (neck.count < 3) {
    neck = {};
    const Eigen::Vector3f middle(0, chin - 0.02F * s, a.skull_centre.z() - 0.01F * s);
    neck.add(middle - Eigen::Vector3f::Constant(0.055F * s));
    neck.add(middle + Eigen::Vector3f::Constant(0.055F * s));
  }
  a.neck_centre = 0.5F * (neck.low + neck.high);
  a.neck_radius = std::clamp(0.5F * (neck.high.x() - neck.low.x()), 0.035F * s, 0.075F * s);

  // Ears stick out of the skull's side; a head without any gets an average pair.
  Extent ears;
  for (const auto& row : a.skin.vertices.rowwise()) {
    if (row.y() > brow || row.y() < brow - 0.1F * s || std::abs(row.x()) < a.skull_radii.x() + 0.004F * s) continue;
    ears.add(row.transpose());
  }
  const float tragus = 0.5F * (a.landmark(0).z() + a.landmark(16).z()) - 0.004F * s;
  const bool seen = ears.count >= 12 && ears.high.y() - ears.low.y() > 0.03F * s;
  a.ear_top = seen ? ears.high.y() : 0.008F * s;
  a.ear_bottom = seen ? ears.low.y() : -0.052F * s;
  a.ear_front = tragus;
  a.ear_back = seen ? ears.low.z() : tragus - 0.05F * s;
  return a;
}

}  // namespace faceprobe::synth
