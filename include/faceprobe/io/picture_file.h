#pragma once
// Pictures and environment maps on disk. The extension picks the format: .exr (half float, ZIP), .hdr (Radiance RGBE), .png
// (8-bit sRGB). Writing is atomic: the target is either the old file or the complete new one, also after a kill or a full
// disk; failure is Error(kOutput) that names the file and the system's reason. Another extension, or channels that
// the format has not, are Error(kUsage).
//
//   io::write_picture("highlight.exr", layers.highlight);
//   const EnvMap studio = io::read_env_map("studio.hdr");

#include "faceprobe/core/env_map.h"
#include "faceprobe/core/image.h"
#include "faceprobe/io/limits.h"

#include <filesystem>
#include <map>
#include <string>

namespace faceprobe::io {

// Text attributes for files that can carry them (EXR, PNG): provenance such as {"faceprobe:version", "0.1.0"}.
using Attributes = std::map<std::string, std::string>;

// Whether pictures are written to such a name: .exr, .hdr or .png, in capitals or not.
bool is_picture_file(const std::filesystem::path& path);

// `image` is linear, 1, 3 or 4 channels. .exr and .hdr keep it as it is (.hdr needs 3 channels and clamps negatives to 0);
// .png encodes it to sRGB, clipped at 1. half_float = false writes 32-bit EXR.
void write_picture(const std::filesystem::path& path, const Image& image, const Attributes& attributes = {},
                   bool half_float = true);
// Already encoded bytes, 1, 3 or 4 channels, to .png.
void write_picture(const std::filesystem::path& path, const ByteImage& image, const Attributes& attributes = {});

// Already encoded bytes, 1, 3 or 4 channels, as a PNG within a text: "data:image/png;base64,..." (RFC 2397, 4648). Throws Error(kOutput).
std::string png_data_uri(const ByteImage& image);

// Lat-long map to .exr (Rec.709 chromaticities; `envmap = latlong` when the columns
// are OpenEXR's) or .hdr, columns rolled to `orientation`;
// .png writes a preview, clipped at 1, whose exposure puts the 90 % quantile at 0.6.
void write_env_map(const std::filesystem::path& path, const EnvMap& map,
                   Orientation orientation = Orientation::kOpenExr, const Attributes& attributes = {});

// Linear picture of an .exr or .hdr: 1 or 3 channels as in the file (alpha dropped); non-finite and negative values become 0.
// Throws Error(kInput) when unreadable, of another kind or over a limit; Error(kUsage) for limits that do not validate.
Image read_linear_picture(const std::filesystem::path& path, const Limits& limits = {});
// As above, and Error(kInput) unless it is 2N x N; one channel becomes three. `orientation`: whose columns the file has.
EnvMap read_env_map(const std::filesystem::path& path, Orientation orientation = Orientation::kOpenExr,
                    const Limits& limits = {});

}  // namespace faceprobe::io
