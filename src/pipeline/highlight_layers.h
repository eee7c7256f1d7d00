#pragma once
// Takes the highlights off a face: by the network unless a classical separator is asked for, or the photo shows too little of the face. Its pictures may have any
// size; the network works on a small copy, as large as those it was trained on, and its layer follows the picture's detail back up.

#include "faceprobe/face/geometry.h"
#include "faceprobe/highlight/separate.h"
#include "faceprobe/pipeline/estimate.h"

#include <memory>

namespace faceprobe::pipeline {

// Whether a photo shows enough of a face's crop (face::face_crop) for the network: two thirds.
bool shows_enough(const face::Crop& crop, int photo_width, int photo_height);

class HighlightSeparator {
 public:
  // Throws Error(kModel): weights that cannot be read.
  explicit HighlightSeparator(const EstimateOptions& options);
  ~HighlightSeparator();
  HighlightSeparator(const HighlightSeparator&) = delete;
  HighlightSeparator& operator=(const HighlightSeparator&) = delete;
  HighlightSeparator(HighlightSeparator&&) = delete;
  HighlightSeparator& operator=(HighlightSeparator&&) = delete;

  // picture: H x W x 3 linear crop of one face; flags: io::Photo::clipped in the crop; skin: H x W x 1, non-zero where to separate;
  // enough: shows_enough(), without which the classical separator steps in.
  highlight::Layers separate(const Image& picture, const ByteImage& flags, const ByteImage& skin, bool enough) const;

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  highlight::SeparateOptions classical_;
};

}  // namespace faceprobe::pipeline
