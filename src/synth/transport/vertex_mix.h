#pragma once
// From values at the rows of a scene transport to fragments.

#include "faceprobe/synth/transport.h"

#include <Eigen/Core>
#include <vector>

namespace faceprobe::synth {

// Fragments::mix_vertex as rows of the transport. Throws std::invalid_argument when a vertex has no row.
std::vector<int> mix_rows(const SceneTransport& transport, const Fragments& fragments);

// to.row(i) = mean of from's rows around fragment i; rows of hair, which has none, are left as they are.
void mix(const Fragments& fragments, const std::vector<int>& rows, const Eigen::MatrixX3f& from, Eigen::MatrixX3f& to);

}  // namespace faceprobe::synth
