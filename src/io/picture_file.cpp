#include "faceprobe/io/picture_file.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/atomic_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <span>

namespace faceprobe::io {
namespace {

constexpr float kLargestHalf = 65504.0F;
constexpr float kLargestRgbe = 1e38F;  // of 1.7e38 (2^127), with room for the encoder's rounding
// zlib levels: the fastest. Writing is a third of a run, and these files are read more often than stored.
constexpr int kPngLevel = 1;
constexpr char kExrCompression[] = "zip:1";

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

[[noreturn]] void refuse_extension(const std::filesystem::path& path, const std::string& allowed) {
  throw Error(ExitCode::kUsage, path.string() + " does not end in " + allowed + ", which pick the format. Rename it.");
}

void require_channels(const std::filesystem::path& path, int channels, bool rgb_only) {
  const bool fine = rgb_only ? channels == 3 : channels == 1 || channels == 3 || channels == 4;
  if (!fine) {
    throw Error(ExitCode::kUsage, path.string() + " cannot hold " + std::to_string(channels) + " channels; " +
                                      (rgb_only ? "an .hdr has 3." : "1, 3 or 4 are allowed."));
  }
}

OIIO::ImageSpec make_spec(int width, int height, int channels, const OIIO::TypeDesc& type, const Attributes& attributes) {
  OIIO::ImageSpec spec(width, height, channels, type);
  if (channels == 1) spec.channelnames = {"Y"};
  for (const auto& [name, value] : attributes) spec.attribute(name, value);
  return spec;
}

// `name`: for messages, and by its extension for the encoders.
std::vector<unsigned char> encoded(const std::filesystem::path& name, const std::string& format,
                                   const OIIO::ImageSpec& spec, const OIIO::TypeDesc& type, const void* values) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const std::unique_ptr<OIIO::ImageOutput> writer = OIIO::ImageOutput::create(format);
  const auto fail = [&] {
    std::string reason = writer ? writer->geterror() : OIIO::geterror();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw Error(ExitCode::kOutput, name.string() + " cannot be encoded: " + reason + ".");
  };
  if (!writer || !writer->set_ioproxy(&memory)) fail();
  if (!writer->open(name.string(), spec) || !writer->write_image(type, values) || !writer->close()) fail();
  return bytes;
}

// Encodes in memory, then writes: the encoders do not report a full disk, write() does.
void encode_and_write(const std::filesystem::path& path, const std::string& format, const OIIO::ImageSpec& spec,
                      const OIIO::TypeDesc& type, const void* values) {
  const std::vector<unsigned char> bytes = encoded(path, format, spec, type, values);
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

// NaN becomes 0; the rest is clamped to [low, high].
Image clamped(const Image& image, float low, float high) {
  Image result = image;
  for (float& value : result.values()) value = std::isnan(value) ? 0.0F : std::clamp(value, low, high);
  return result;
}

void write_exr(const std::filesystem::path& path, const Image& image, const Attributes& attributes, bool half_float,
               bool env_map) {
  const OIIO::TypeDesc type = half_float ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec = make_spec(image.width(), image.height(), image.channels(), type, attributes);
  spec.attribute("compression", kExrCompression);
  // OpenImageIO would write the present time as the time of capture: it is not, and the same picture would give another file.
  spec.attribute("DateTime", "");
  if (image.channels() >= 3) {
    constexpr float kRec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), kRec709);
  }
  // OpenImageIO's name for OpenEXR's standard attribute `envmap = latlong`.
  if (env_map) spec.attribute("textureformat", "LatLong Environment");
  const float limit = half_float ? kLargestHalf : std::numeric_limits<float>::max();
  encode_and_write(path, "openexr", spec, OIIO::TypeDesc::FLOAT, clamped(image, -limit, limit).data());
}

void write_hdr(const std::filesystem::path& path, const Image& image, const Attributes& attributes) {
  require_channels(path, image.channels(), true);
  const OIIO::ImageSpec spec = make_spec(image.width(), image.height(), 3, OIIO::TypeDesc::FLOAT, attributes);
  encode_and_write(path, "hdr", spec, OIIO::TypeDesc::FLOAT, clamped(image, 0.0F, kLargestRgbe).data());
}

std::vector<unsigned char> png_of(const std::filesystem::path& name, const ByteImage& image,
                                  const Attributes& attributes) {
  OIIO::ImageSpec spec = make_spec(image.width(), image.height(), image.channels(), OIIO::TypeDesc::UINT8, attributes);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("oiio:UnassociatedAlpha", 1);  // written as it is, not divided by alpha
  spec.attribute("png:compressionLevel", kPngLevel);
  return encoded(name, "png", spec, OIIO::TypeDesc::UINT8, image.data());
}

void write_png(const std::filesystem::path& path, const ByteImage& image, const Attributes& attributes) {
  const std::vector<unsigned char> bytes = png_of(path, image, attributes);
  write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

// Colour to sRGB; a fourth channel is coverage and stays proportional.
ByteImage encode_with_alpha(const Image& image) {
  ByteImage encoded(image.width(), image.height(), 4);
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const float value = image.data()[i] > 0 ? std::min(image.data()[i], 1.0F) : 0.0F;
    encoded.data()[i] = static_cast<std::uint8_t>((i % 4 == 3 ? value : srgb_from_linear(value)) * 255.0F + 0.5F);
  }
  return encoded;
}

}  // namespace

bool is_picture_file(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".exr" || extension == ".hdr" || extension == ".png";
}

void write_picture(const std::filesystem::path& path, const Image& image, const Attributes& attributes, bool half_float) {
  require_channels(path, image.channels(), false);
  const std::string extension = extension_of(path);
  if (extension == ".exr") {
    write_exr(path, image, attributes, half_float, false);
  } else if (extension == ".hdr") {
    write_hdr(path, image, attributes);
  } else if (extension == ".png") {
    write_png(path, image.channels() == 4 ? encode_with_alpha(image) : encode_srgb(image), attributes);
  } else {
    refuse_extension(path, ".exr, .hdr or .png");
  }
}

void write_picture(const std::filesystem::path& path, const ByteImage& image, const Attributes& attributes) {
  require_channels(path, image.channels(), false);
  if (extension_of(path) != ".png") refuse_extension(path, ".png");
  write_png(path, image, attributes);
}

std::string png_data_uri(const ByteImage& image) {
  const std::filesystem::path name = "picture.png";
  require_channels(name, image.channels(), false);
  const std::vector<unsigned char> bytes = png_of(name, image, {});
  return "data:image/png;base64," +
         OIIO::Strutil::base64_encode({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void write_env_map(const std::filesystem::path& path, const EnvMap& map, Orientation orientation,
                   const Attributes& attributes) {
  const EnvMap rolled = orientation == Orientation::kOpenExr ? map : to_orientation(map, orientation);
  const Image& radiance = rolled.radiance();
  const std::string extension = extension_of(path);
  if (extension == ".exr") {
    // The attribute promises OpenEXR's own columns, which a rolled map no longer has.
    write_exr(path, radiance, attributes, true, orientation == Orientation::kOpenExr);
  } else if (extension == ".hdr") {
    write_hdr(path, radiance, attributes);
  } else if (extension == ".png") {
    constexpr float kPreviewQuantile = 0.9F;
    constexpr float kPreviewLevel = 0.6F;
    const float gain = exposure_for_quantile(radiance, kPreviewQuantile, kPreviewLevel);
    write_png(path, encode_srgb(radiance, gain), attributes);
  } else {
    refuse_extension(path, ".exr, .hdr or .png");
  }
}

}  // namespace faceprobe::io
