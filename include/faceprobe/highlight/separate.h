#pragma once
// Splits a face into what its surface mirrors (highlight) and what comes out of the skin (diffuse), in linear light:
// picture = highlight + diffuse, both non-negative in every channel.
//
// The three separators here are classical: they need colour (a grey photo gives an empty highlight layer) and assume
// the light is white, which is why the picture is divided by `light_colour` first and multiplied back after. What a
// classical separator takes for highlight is the white part of a surface: a white or grey object among coloured ones
// goes with it.
//
// Time grows with the pixels, least for shen, most for tan (bench_separation prints it for 2000 x 2000). tan sweeps the
// picture on one thread, never more than 2550 times; it leaves alone pixels below 20/255 in all channels.
//
//   Layers layers = separate(crop, mask, {.separator = Separator::kShen});

#include "faceprobe/core/image.h"

#include <array>
#include <string>
#include <string_view>

namespace faceprobe::highlight {

enum class Separator {
  kTan,   // Tan & Ikeuchi 2005, "Separating reflection components of textured surfaces using a single image" (PAMI 27)
  kYang,  // Yang, Wang & Ahuja 2010, "Real-time specular highlight removal using bilateral filtering" (ECCV)
  kShen,  // Shen & Zheng 2013, "Real-time highlight removal using intensity ratio" (Applied Optics 52)
};
std::string_view separator_name(Separator separator);  // "tan", "yang", "shen"
// Throws Error(kUsage) listing the names there are.
Separator separator_from_name(std::string_view name);

struct SeparateOptions {
  Separator separator = Separator::kYang;
  std::array<float, 3> light_colour = {1, 1, 1};  // linear RGB of the light; only the ratio counts
  int threads = 0;

  std::string validate() const;
};

struct Layers {
  Image highlight;  // H x W x 3, linear, 0 outside the mask
  Image diffuse;    // H x W x 3, picture - highlight
};

// `linear`: H x W x 3. `mask`: H x W x 1, non-zero where to separate; empty = everywhere. Statistics are taken inside
// the mask only. Throws std::invalid_argument when sizes or channels differ, Error(kUsage) for options that do not
// validate.
Layers separate(const Image& linear, const ByteImage& mask, const SeparateOptions& options);

}  // namespace faceprobe::highlight
