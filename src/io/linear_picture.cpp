#include "faceprobe/core/error.h"
#include "faceprobe/io/picture_file.h"
#include "io/decoder.h"
#include "io/photo_bytes.h"
#include "io/read_file.h"

namespace faceprobe::io {

Image linear_picture_from_bytes(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
  const Header header = accept_header(bytes, name, limits);
  if (header.format != "exr" && header.format != "hdr") {
    throw Error(ExitCode::kInput,
                name + " is a " + header.format + " file; a linear picture is read from .exr or .hdr only.");
  }
  Decoder decoder(bytes, header, name);
  const int colours = decoder.colour_channels();
  Image picture(decoder.width(), decoder.height(), colours);
  CleanCount counts;
  if (!decoder.has_alpha()) {
    decoder.read_rows(0, decoder.height(), picture.data());
  } else {
    std::vector<float> row(static_cast<std::size_t>(decoder.width()) * static_cast<std::size_t>(decoder.channels()));
    for (int y = 0; y < decoder.height(); ++y) {
      decoder.read_rows(y, 1, row.data());
      for (int x = 0; x < decoder.width(); ++x) {
        std::copy_n(row.data() + std::ptrdiff_t{x} * decoder.channels(), colours, picture.pixel(x, y));
      }
    }
  }
  clean_light(picture.data(), picture.values().size(), counts);
  return picture;
}

Image read_linear_picture(const std::filesystem::path& path, const Limits& limits) {
  if (const std::string problem = limits.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  return linear_picture_from_bytes(read_regular_file(path, limits.max_file_bytes, kFileBytesAdvice), path.string(),
                                   limits);
}

EnvMap read_env_map(const std::filesystem::path& path, Orientation orientation, const Limits& limits) {
  Image picture = read_linear_picture(path, limits);
  if (picture.width() != 2 * picture.height()) {
    throw Error(ExitCode::kInput, path.string() + " is " + std::to_string(picture.width()) + " x " +
                                      std::to_string(picture.height()) +
                                      " px; an environment map is twice as wide as high. Crop or resize it.");
  }
  if (picture.channels() == 1) {
    Image colour(picture.width(), picture.height(), 3);
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) std::fill_n(colour.data() + 3 * i, 3, picture.data()[i]);
    picture = std::move(colour);
  }
  const EnvMap map(std::move(picture));
  return orientation == Orientation::kOpenExr ? map : from_orientation(map, orientation);
}

}  // namespace faceprobe::io
