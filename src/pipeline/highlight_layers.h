#pragma once
// Takes the highlights off a face: by the network where weights are named, else by a classical separator. Its pictures may have any
// size; the network works on a small copy, as large as those it was trained on, and its layer follows the picture's detail back up.

#include "faceprobe/highlight/separate.h"
#include "faceprobe/pipeline/estimate.h"

#include <memory>

namespace faceprobe::pipeline {

class HighlightSeparator {
 public:
  // Throws Error(kModel): weights that cannot be read.
  explicit HighlightSeparator(const EstimateOptions& options);
  ~HighlightSeparator();
  HighlightSeparator(const HighlightSeparator&) = delete;
  HighlightSeparator& operator=(const HighlightSeparator&) = delete;
  HighlightSeparator(HighlightSeparator&&) = delete;
  HighlightSeparator& operator=(HighlightSeparator&&) = delete;

  // picture: H x W x 3 linear crop of one face; flags: io::Photo::clipped in the crop; skin: H x W x 1, non-zero where to separate.
  highlight::Layers separate(const Image& picture, const ByteImage& flags, const ByteImage& skin) const;

 private:
  struct Network;
  std::unique_ptr<Network> network_;
  highlight::SeparateOptions classical_;
};

}  // namespace faceprobe::pipeline
