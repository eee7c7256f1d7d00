#pragma once
// What a file may ask of us before we refuse it. Every limit is checked from the file's own header, by our parser, before a
// decoder allocates anything; the error names the limit and the value found.
//
//   const io::Photo photo = io::load_photo("upload.jpg", {.max_pixels = 20'000'000});

#include <cstdint>
#include <string>

namespace faceprobe::io {

struct Limits {
  std::int64_t max_file_bytes = 256LL << 20;  // 256 MiB
  std::int64_t max_pixels = 100'000'000;      // width x height
  int max_side_px = 32768;                    // width or height; at most 1048576
  int max_channels = 64;
  int max_jpeg_scans = 100;                        // each scan of a progressive JPEG costs a pass over the picture
  std::int64_t max_icc_bytes = 4LL << 20;          // larger profiles are ignored with a warning
  double max_expansion = 10'000;                   // declared bytes : file bytes ...
  std::int64_t expansion_free_bytes = 64LL << 20;  // ... once the declared size is over this

  // Empty when usable, else a sentence that says which value is wrong.
  std::string validate() const;
};

}  // namespace faceprobe::io
