#pragma once
// The passes of a multilayer EXR as Blender writes it.

#include "faceprobe/core/image.h"

#include <filesystem>
#include <string>
#include <vector>

namespace faceprobe::bench {

class PassFile {
 public:
  // Throws Error(kModel) when it cannot be read; Blender's log is taken to lie beside it.
  explicit PassFile(std::filesystem::path path);
  // The channels whose names end in `.NAME.LETTER`, in the order of `letters`. Throws Error(kModel) when there is no such pass.
  Image pass(const std::string& name, const std::string& letters) const;

 private:
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<float> values_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace faceprobe::bench
