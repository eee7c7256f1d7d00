#pragma once
// Splits the highlight layer off a face's picture by a trained network. Unlike the classical separators (highlight/separate.h) it
// works on grey photos and under coloured light. Give it a crop of one face at about the size it was trained at (ModelInfo's
// metadata); it was trained on faces only. Runs the U-Net, on the processor; torch_highlight_net.h has the rest.
//
//   const net::HighlightNet network("models/highlight.safetensors", {.threads = 0});
//   const Image highlight = network.highlight(crop, clip, mask);   // diffuse = crop - highlight

#include "faceprobe/core/image.h"
#include "faceprobe/net/model_file.h"

#include <filesystem>
#include <memory>
#include <string>

namespace faceprobe::net {

struct HighlightNetOptions {
  int threads = 0;  // 0 = all processors; the result does not depend on it

  std::string validate() const;
};

class HighlightNet {
 public:
  // Throws Error(kModel): the file is not there, damaged, or of another network; Error(kUsage): the options do not validate.
  explicit HighlightNet(const std::filesystem::path& weights, const HighlightNetOptions& options = {});
  HighlightNet(const HighlightNet&) = delete;
  HighlightNet& operator=(const HighlightNet&) = delete;
  HighlightNet(HighlightNet&&) noexcept;
  HighlightNet& operator=(HighlightNet&&) noexcept;
  ~HighlightNet();

  // `linear`: H x W x 3, any size; NaN, infinity and what is below zero count as 0. `clip`: H x W x 1, bits 0 to 2 set where red,
  // green, blue were clipped in the file; empty = nowhere. `mask`: H x W x 1, non-zero on the face; empty = everywhere.
  // Result: H x W x 3, linear; 0 <= highlight <= picture in every channel, 0 outside the mask. A picture that is grey everywhere
  // (three equal channels) gives a grey result, the mean of what the network says of the three. May be called from several
  // threads. Throws std::invalid_argument when sizes or channels differ.
  Image highlight(const Image& linear, const ByteImage& clip, const ByteImage& mask) const;

  const ModelInfo& info() const;  // what the weights file says of itself

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace faceprobe::net
