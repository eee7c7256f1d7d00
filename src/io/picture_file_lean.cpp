// In place of picture_file.cpp where there is no OpenImageIO: encoded bytes to .png, and nothing else.

#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"
#include "faceprobe/io/picture_file.h"
#include "io/plain_png.h"

namespace faceprobe::io {

void write_picture(const std::filesystem::path& path, const ByteImage& image, const Attributes& /*attributes*/) {
  if (path.extension() != ".png") {
    throw Error(ExitCode::kUsage,
                path.string() + " does not end in .png, the only format that this build writes. Rename it.");
  }
  write_file_atomically(path, plain_png(image));
}

}  // namespace faceprobe::io
