#include "synth/transport/vertex_mix.h"

#include <stdexcept>

namespace faceprobe::synth {

std::vector<int> mix_rows(const SceneTransport& transport, const Fragments& fragments) {
  if (static_cast<int>(fragments.mix_first.size()) != fragments.count() + 1) {
    throw std::invalid_argument("Fragments must come from find_fragments(), with the vertices around each.");
  }
  std::vector<int> rows;
  rows.reserve(fragments.mix_vertex.size());
  for (const int vertex : fragments.mix_vertex) {
    rows.push_back(transport.row_of_vertex[static_cast<std::size_t>(vertex)]);
    if (rows.back() < 0) {
      throw std::invalid_argument("A fragment's vertex has no row; take the vertices from vertices_seen().");
    }
  }
  return rows;
}

void mix(const Fragments& fragments, const std::vector<int>& rows, const Eigen::MatrixX3f& from, Eigen::MatrixX3f& to) {
  // All channels at once: the indices are what takes the time.
  const float* red = from.col(0).data();
  const float* green = from.col(1).data();
  const float* blue = from.col(2).data();
  const auto count = static_cast<Eigen::Index>(fragments.mix_first.size()) - 1;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int first = fragments.mix_first[at];
    const int last = fragments.mix_first[at + 1];
    if (first == last) continue;
    float r = 0;
    float g = 0;
    float b = 0;
    for (int k = first; k < last; ++k) {
      const float weight = fragments.mix_weight[static_cast<std::size_t>(k)];
      const int row = rows[static_cast<std::size_t>(k)];
      r += weight * red[row];
      g += weight * green[row];
      b += weight * blue[row];
    }
    to(i, 0) = r;
    to(i, 1) = g;
    to(i, 2) = b;
  }
}

}  // namespace faceprobe::synth
