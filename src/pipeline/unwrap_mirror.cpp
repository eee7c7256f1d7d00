#include "pipeline/unwrap_mirror.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace faceprobe::pipeline {
namespace {

constexpr float kPartnerM = 0.003F;
constexpr float kTrust = 0.7F;  // of the other half: moles and partings are not symmetric

// Each vertex's partner on the other side, or -1. Sorted by x, so that only a thin slice has to be looked through.
std::vector<int> partners(const Eigen::MatrixX3f& vertices, const std::vector<std::uint8_t>& used) {
  std::vector<int> order;
  for (int v = 0; v < vertices.rows(); ++v) {
    if (used[static_cast<std::size_t>(v)] != 0) order.push_back(v);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) { return vertices(a, 0) < vertices(b, 0); });
  std::vector<int> partner(static_cast<std::size_t>(vertices.rows()), -1);
  for (const int v : order) {
    const Eigen::RowVector3f wanted(-vertices(v, 0), vertices(v, 1), vertices(v, 2));
    auto at = std::lower_bound(order.begin(), order.end(), wanted.x() - kPartnerM,
                               [&](int a, float x) { return vertices(a, 0) < x; });
    float nearest = kPartnerM;
    for (; at != order.end() && vertices(*at, 0) <= wanted.x() + kPartnerM; ++at) {
      const float distance = (vertices.row(*at) - wanted).norm();
      if (distance < nearest) {
        nearest = distance;
        partner[static_cast<std::size_t>(v)] = *at;
      }
    }
  }
  return partner;
}

// The first UV that each vertex has in the chosen triangles.
Eigen::MatrixX2f first_uv(const synth::HeadModel& model, const std::vector<int>& skin, std::vector<std::uint8_t>& used) {
  Eigen::MatrixX2f uv = Eigen::MatrixX2f::Zero(model.neutral.rows(), 2);
  used.assign(static_cast<std::size_t>(model.neutral.rows()), 0);
  for (const int t : skin) {
    for (int corner = 0; corner < 3; ++corner) {
      const int v = model.triangles(t, corner);
      if (used[static_cast<std::size_t>(v)] != 0) continue;
      used[static_cast<std::size_t>(v)] = 1;
      uv.row(v) = model.uv.row(model.triangle_uv(t, corner));
    }
  }
  return uv;
}

}  // namespace

void add_mirrored(const synth::HeadModel& model, const std::vector<int>& skin, const MeshRaster& texels, Image& colour,
                  Image& weight) {
  std::vector<std::uint8_t> used;
  const Eigen::MatrixX2f uv = first_uv(model, skin, used);
  const std::vector<int> partner = partners(model.neutral, used);
  const Image known_colour = colour;
  const Image known_weight = weight;
  for (int y = 0; y < texels.height; ++y) {
    for (int x = 0; x < texels.width; ++x) {
      const RasterCell& cell = texels.at(x, y);
      if (cell.triangle < 0 || known_weight(x, y) >= 1.0F) continue;
      Eigen::RowVector2f opposite = Eigen::RowVector2f::Zero();
      bool whole = true;
      for (int corner = 0; corner < 3 && whole; ++corner) {
        const int other = partner[static_cast<std::size_t>(model.triangles(cell.triangle, corner))];
        whole = other >= 0;
        if (whole) opposite += cell.weights[corner] * uv.row(other);
      }
      if (!whole) continue;
      const int ox = static_cast<int>(opposite.x() * static_cast<float>(texels.width));
      const int oy = static_cast<int>((1.0F - opposite.y()) * static_cast<float>(texels.height));
      if (ox < 0 || oy < 0 || ox >= texels.width || oy >= texels.height) continue;
      const float here = known_weight(x, y);
      const float there = kTrust * (1.0F - here) * std::max(0.0F, known_weight(ox, oy) - here);
      if (there <= 0.0F) continue;
      for (int c = 0; c < 3; ++c)
        colour(x, y, c) = (here * known_colour(x, y, c) + there * known_colour(ox, oy, c)) / (here + there);
      weight(x, y) = here + there;
    }
  }
}

}  // namespace faceprobe::pipeline
