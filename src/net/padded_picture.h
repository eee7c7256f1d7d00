#pragma once
// A picture made fit for a network: sides that are multiples, and no number that is not one.

#include "faceprobe/core/image.h"

namespace faceprobe::net {

// The three inputs, as long and wide as the next multiples: the last row and column are repeated beyond the picture.
struct PaddedPicture {
  Image linear;  // 3 channels; NaN, infinity and what is below zero have become 0
  Image clip;    // 3 channels of 0 and 1
  Image mask;    // 1 channel of 0 and 1
};
// `linear`: H x W x 3, not empty. `clip`: H x W x 1, bits 0 to 2 are the channels; empty = nothing was clipped. `mask`: H x W x 1,
// non-zero on the face; empty = everywhere.
PaddedPicture pad_picture(const Image& linear, const ByteImage& clip, const ByteImage& mask, int multiple);

// The top left part of a padded picture, any number of channels.
Image top_left(const Image& image, int width, int height);

// What a network says of a picture, kept within it whatever it is: 0 <= highlight <= picture, nothing outside the mask (empty =
// everywhere), not-a-numbers 0, and grey where `grey`: the mean of the three channels. `linear` is at least as large.
void keep_within(Image& highlight, const Image& linear, const ByteImage& mask, bool grey);
// Whether the three channels are equal everywhere.
bool is_grey(const Image& linear);

// Throws std::invalid_argument unless `linear` has three channels, and clip and mask, where given, one and its size.
void check_sizes(const Image& linear, const ByteImage& clip, const ByteImage& mask);

}  // namespace faceprobe::net
