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
  for (int c = 0; c < 3; ++c) {
    const float* values = from.col(c).data();
    float* out = to.col(c).data();
    for (std::size_t i = 0; i + 1 < fragments.mix_first.size(); ++i) {
      const int first = fragments.mix_first[i];
      const int last = fragments.mix_first[i + 1];
      if (first == last) continue;
      float sum = 0;
      for (int k = first; k < last; ++k) {
        sum += fragments.mix_weight[static_cast<std::size_t>(k)] * values[rows[static_cast<std::size_t>(k)]];
      }
      out[i] = sum;
    }
  }
}

}  // namespace faceprobe::synth
