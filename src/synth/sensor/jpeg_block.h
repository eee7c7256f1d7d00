#pragma once
// Internal: JPEG's lossy step on one component: 8x8 DCT (ITU-T T.81, A.3.3), quantisation with a table of Annex K, and back.

#include <Eigen/Core>

namespace faceprobe::synth {

using JpegBlock = Eigen::Array<float, 8, 8, Eigen::RowMajor>;

// Tables K.1 and K.2 of Annex K, scaled as libjpeg does for a quality of 1 .. 100 (8-bit entries).
JpegBlock luminance_table(int quality);
JpegBlock chrominance_table(int quality);

// In place, on values about 0 .. 255; the edges are repeated up to whole blocks. The result is whole numbers, 0 .. 255.
void quantise_component(float* plane, int width, int height, const JpegBlock& table);

}  // namespace faceprobe::synth
