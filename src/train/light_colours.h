#pragma once
// Several light colours in one photo, such as a window and a lamp: what skin cannot tell by itself, for it has colours of its own. A person's
// other photos say those: one photo over the mean of all is light over light.
//
//   const std::vector<double> spreads = light_colour_spreads(photos);   // of one person, 2 or more
//   measures.light_colour_spread = spreads[k];                          // train/finetune_guards.h says which are too many
//
// Not for people of whom all photos have the same two lights in the same places: those pass for colours of the skin.

#include "faceprobe/core/image.h"

#include <vector>

namespace faceprobe::train {

// In the template's square (train/frontalise.h).
struct SquarePhoto {
  Image linear;      // S x S x 3
  ByteImage usable;  // S x S x 1, non-zero = skin that the photo shows, unclipped
};

// chroma_spread() of each photo over the mean of all, where two or more show the skin; 0 where that is too little to say. Exposure and
// the colour of a photo as a whole do not enter. Of each block of the square the median counts, so that a highlight, which whitens a part
// of it, is no light colour: on photos of `faceprobe synth` the medians have the spread of the true shading, and single pixels a fifth
// more. A spread s of one photo of n reads as s (n - 1) / n, and as s / n in the others, whose measure it is part of: leave out the worst
// and ask again. Throws std::invalid_argument: sizes that differ.
std::vector<double> light_colour_spreads(const std::vector<SquarePhoto>& photos);

}  // namespace faceprobe::train
