#pragma once
// Internal: is the dominant light small? The glow that the solver found is replaced by a disc, of the sun's size and of others up to a wide window's,
// at a place refined to the rows; surround and disc are fitted anew for each, highlights and shading each by itself, because the gain between them is
// known to a quarter only. A disc of at most 20 degrees is kept where
//
//   - it explains the rows better than the glow by 10 in twice the log likelihood, "very strong" evidence in Kass & Raftery 1995. Neither has fewer
//     unknowns: a disc has a place and a width, a glow has these and its profile too, so BIC takes nothing more off, and it would favour the disc;
//   - and better than the best wider disc, which has as many unknowns, by 6, "strong": a window is no lamp.
//
// The noise is the glow's own residual, robustly, and neighbouring rows that are wrong alike count as fewer (robust_rows.h).

#include "faceprobe/lighting/estimate.h"

#include <optional>

namespace faceprobe::lighting {

struct CompactFit {
  CompactLight light;
  Eigen::MatrixX3f surround;  // #cells x 3: the map without the light
};

// `observations`: as the solver saw them, highlights on the shading's scale. `transport`: theirs on `grid`. `spread`: radiance, confidence and ambient of
// what was found. Nothing where no light stands out, where the wide ones fit as well, and of under 50 patches.
std::optional<CompactFit> fit_compact_light(const Observations& observations, const Transport& transport,
                                            bool use_highlights, const SphereGrid& grid, const Light& spread,
                                            const SolveOptions& options);

}  // namespace faceprobe::lighting
