#include "cycles/passes.h"

#include "faceprobe/core/error.h"

#include <OpenImageIO/imageio.h>

namespace faceprobe::bench {

PassFile::PassFile(std::filesystem::path path) : path_(std::move(path)) {
  const auto file = OIIO::ImageInput::open(path_.string());
  if (!file) throw Error(ExitCode::kModel, "Blender left no picture " + path_.string() + "; its log is beside it.");
  const OIIO::ImageSpec spec = file->spec();
  values_.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values_.data())) {
    throw Error(ExitCode::kModel, "Cannot read " + path_.string() + ".");
  }
  names_ = spec.channelnames;
  width_ = spec.width;
  height_ = spec.height;
}

Image PassFile::pass(const std::string& name, const std::string& letters) const {
  std::vector<std::size_t> channels;
  for (const char letter : letters) {
    const std::string end = "." + name + "." + letter;
    for (std::size_t c = 0; c < names_.size(); ++c) {
      if (names_[c].ends_with(end)) channels.push_back(c);
    }
  }
  if (channels.size() != letters.size()) {
    throw Error(ExitCode::kModel, path_.string() + " has no pass " + name + "; Blender 3.x writes it.");
  }
  Image out(width_, height_, static_cast<int>(letters.size()));
  for (std::size_t i = 0; i < out.pixel_count(); ++i) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      out.values()[i * channels.size() + c] = values_[i * names_.size() + channels[c]];
  }
  return out;
}

}  // namespace faceprobe::bench
