#include "faceprobe/io/photo.h"

#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "io/colour_model.h"
#include "io/decoder.h"
#include "io/exif.h"
#include "io/icc.h"
#include "io/orientation.h"
#include "io/photo_bytes.h"
#include "io/read_file.h"

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace faceprobe::io {
namespace {

constexpr int kBlockRows =
    32;  // rows decoded at a time: the encoded picture never exists as a whole beside the linear one

// A value from here on may have been cut off at the top of the range.
template <class Code>
constexpr Code clip_threshold() {
  if constexpr (sizeof(Code) == 1) {
    return 254;  // 255, less one code for the rounding of JPEG's colour transform
  } else {
    // Raw converters put sensor saturation within a few codes of 65535. An 8-bit 254 widened to 16 bits is 65278 and so not
    // clipped: without JPEG's rounding, only the top code says so.
    return 65500;
  }
}

template <class Code>
class Loader {
 public:
  Loader(Decoder& decoder, const ColourModel& model, const Upright& place, bool lossy, Photo& photo)
      : decoder_(decoder), model_(model), place_(place), grey_tolerance_(lossy && sizeof(Code) == 1 ? 1 : 0),
        photo_(photo) {}

  void run() {
    const int width = decoder_.width();
    const int height = decoder_.height();
    const auto row_pixels = static_cast<std::size_t>(width);
    photo_.linear = Image(place_.width, place_.height, 3);
    photo_.clipped = ByteImage(place_.width, place_.height, 1);
    photo_.grey = true;
    std::vector<Code> codes(row_pixels * kBlockRows * static_cast<std::size_t>(decoder_.channels()));
    std::vector<float> linear(row_pixels * kBlockRows * 3);
    std::vector<std::uint8_t> flags(row_pixels * kBlockRows);
    for (int first = 0; first < height; first += kBlockRows) {
      const int rows = std::min(kBlockRows, height - first);
      const std::size_t pixels = row_pixels * static_cast<std::size_t>(rows);
      decoder_.read_rows(first, rows, codes.data());
      look_at_codes(codes.data(), pixels, flags.data());
      model_.to_linear(codes.data(), decoder_.channels(), pixels, linear.data());
      if constexpr (sizeof(Code) == sizeof(float)) clean_light(linear.data(), 3 * pixels, counts_);
      place_rows(place_, linear.data(), width, first, rows, 3, photo_.linear.data());
      place_rows(place_, flags.data(), width, first, rows, 1, photo_.clipped.data());
    }
    report();
  }

 private:
  // Clipping, transparency and greyness are facts about the encoded values; no conversion may come before.
  void look_at_codes(const Code* codes, std::size_t pixels, std::uint8_t* flags) {
    const int channels = decoder_.channels();
    const int colours = decoder_.colour_channels();
    const bool alpha = decoder_.has_alpha();
    bool grey = true;
    for (std::size_t i = 0; i < pixels; ++i, codes += channels) {
      unsigned flag = 0;
      if (colours == 3) {
        if constexpr (sizeof(Code) < sizeof(float)) {
          flag = (codes[0] >= clip_threshold<Code>() ? unsigned{kClippedRed} : 0U) |
                 (codes[1] >= clip_threshold<Code>() ? unsigned{kClippedGreen} : 0U) |
                 (codes[2] >= clip_threshold<Code>() ? unsigned{kClippedBlue} : 0U);
          grey &= std::abs(codes[0] - codes[1]) <= grey_tolerance_ && std::abs(codes[1] - codes[2]) <= grey_tolerance_;
        } else {
          grey &= codes[0] == codes[1] && codes[1] == codes[2];
        }
      } else if constexpr (sizeof(Code) < sizeof(float)) {
        if (codes[0] >= clip_threshold<Code>()) flag = kClippedRed | kClippedGreen | kClippedBlue;
      }
      if (alpha && is_transparent(codes[colours])) flag |= kTransparent;
      flags[i] = static_cast<std::uint8_t>(flag);
    }
    photo_.grey = photo_.grey && grey;
  }

  static bool is_transparent(Code alpha) {
    if constexpr (sizeof(Code) == sizeof(float)) {
      return !(alpha >= 0.999F);  // half floats round 1 to within 5e-4
    } else {
      return alpha < static_cast<Code>(~Code{0});
    }
  }

  void report() {
    if (counts_.not_finite > 0) {
      photo_.warnings.push_back(std::to_string(counts_.not_finite) +
                                " values are infinite or not numbers; they count as 0.");
    }
    if (counts_.negative > 0) {
      photo_.warnings.push_back(std::to_string(counts_.negative) + " values are negative; they count as 0.");
    }
  }

  Decoder& decoder_;
  const ColourModel& model_;
  Upright place_;
  int grey_tolerance_;
  Photo& photo_;
  CleanCount counts_;
};

std::size_t levels_of(CodeType type) { return type == CodeType::kByte ? 256 : type == CodeType::kShort ? 65536 : 0; }

std::optional<ColourModel> model_from_profile(const Decoder& decoder, const Limits& limits, Photo& photo) {
  const OIIO::ParamValue* profile = decoder.spec().find_attribute("ICCProfile");
  if (profile == nullptr) return std::nullopt;
  const std::size_t size = profile->type().size();
  std::string problem;
  if (static_cast<std::int64_t>(size) > limits.max_icc_bytes) {
    problem = "has " + std::to_string(size) + " bytes, at most " + std::to_string(limits.max_icc_bytes) + " are allowed";
  } else {
    const std::span<const std::byte> bytes(static_cast<const std::byte*>(profile->data()), size);
    auto model = model_from_icc(bytes, decoder.colour_channels(), levels_of(decoder.type()), problem);
    if (model) return model;
  }
  photo.warnings.push_back("The ICC profile " + problem + "; sRGB is assumed.");
  return std::nullopt;
}

ColourModel choose_model(const Decoder& decoder, const Header& header, const Limits& limits, Photo& photo) {
  const int channels = decoder.colour_channels();
  const std::size_t levels = levels_of(decoder.type());
  if (header.format == "exr" || header.format == "hdr") return linear_model(channels, levels);
  if (auto model = model_from_profile(decoder, limits, photo)) return *model;
  if (decoder.type() == CodeType::kFloat) {
    photo.warnings.emplace_back("Floating-point values without a colour profile are taken as linear.");
    return linear_model(channels, levels);
  }
  // PNG's gAMA chunk; 2.2 is what writers put there to mean sRGB.
  const float gamma = decoder.spec().get_float_attribute("oiio:Gamma", 2.2F);
  if (header.format == "png" && gamma >= 0.9F && gamma <= 4.0F && std::abs(gamma - 2.2F) > 0.1F) {
    return gamma < 1.05F ? linear_model(channels, levels) : gamma_model(channels, levels, gamma);
  }
  return srgb_model(channels, levels);
}

bool contains(std::span<const std::byte> bytes, std::string_view text) {
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).find(text) !=
         std::string_view::npos;
}

void warn_about_extras(const Decoder& decoder, const Header& header, std::span<const std::byte> bytes, Photo& photo) {
  constexpr std::size_t kMetadataBytes = 128 << 10;  // XMP stands in the first segments
  if (header.format == "jpeg" && contains(bytes.first(std::min(bytes.size(), kMetadataBytes)), "hdrgm:Version")) {
    photo.warnings.emplace_back("The gain map (Ultra HDR) is ignored; the standard picture is read.");
  }
  const OIIO::ParamValue* chromaticities = decoder.spec().find_attribute("chromaticities");
  if (chromaticities != nullptr && chromaticities->type().basevalues() == 8 &&
      chromaticities->type().basetype == OIIO::TypeDesc::FLOAT) {
    constexpr float kRec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    const auto* found = static_cast<const float*>(chromaticities->data());
    for (int i = 0; i < 8; ++i) {
      if (std::abs(found[i] - kRec709[i]) > 0.01F) {
        photo.warnings.emplace_back("The file's primaries are not Rec.709; its values are read as if they were.");
        return;
      }
    }
  }
}

}  // namespace

void clean_light(float* values, std::size_t count, CleanCount& counts) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) {
      values[i] = 0;
      ++counts.not_finite;
    } else if (values[i] < 0) {
      values[i] = 0;
      ++counts.negative;
    }
  }
}

Photo photo_from_bytes(std::span<const std::byte> bytes, const std::string& name, const Limits& limits) {
  const Header header = accept_header(bytes, name, limits);
  Photo photo;
  photo.format = header.format;
  photo.bits_per_channel = header.bits;
  photo.sha256 = sha256_hex(bytes.data(), bytes.size());
  Decoder decoder(bytes, header, name);
  const ColourModel model = choose_model(decoder, header, limits, photo);
  photo.colour_space = model.name;
  const OIIO::ImageSpec attributes = with_exif(decoder.spec(), header, bytes);
  // libheif has turned the picture already, by HEIF's own properties; what its EXIF block says then must not count again.
  photo.exif_orientation = header.format == "heif" ? 1 : exif_orientation(attributes);
  photo.focal_px = exif_focal_px(attributes);
  const Upright place = upright(photo.exif_orientation, decoder.width(), decoder.height());
  switch (decoder.type()) {
    case CodeType::kByte: Loader<std::uint8_t>(decoder, model, place, header.lossy, photo).run(); break;
    case CodeType::kShort: Loader<std::uint16_t>(decoder, model, place, header.lossy, photo).run(); break;
    case CodeType::kFloat: Loader<float>(decoder, model, place, header.lossy, photo).run(); break;
  }
  warn_about_extras(decoder, header, bytes, photo);
  return photo;
}

Photo load_photo(const std::filesystem::path& path, const Limits& limits) {
  if (const std::string problem = limits.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  const std::vector<std::byte> bytes = read_regular_file(path, limits.max_file_bytes, kFileBytesAdvice);
  return photo_from_bytes(bytes, path.string(), limits);
}

Photo photo_from_srgb(const ByteImage& srgb) {
  if (srgb.channels() != 3) throw std::invalid_argument("A picture in sRGB has three channels.");
  Photo photo;
  photo.linear = decode_srgb(srgb);
  photo.clipped = ByteImage(srgb.width(), srgb.height(), 1);
  photo.grey = true;
  photo.format = "memory";
  photo.colour_space = "sRGB";
  constexpr std::uint8_t kBits[] = {kClippedRed, kClippedGreen, kClippedBlue};
  for (std::size_t i = 0; i < srgb.pixel_count(); ++i) {
    const std::uint8_t* code = srgb.data() + 3 * i;
    photo.grey = photo.grey && code[0] == code[1] && code[1] == code[2];
    for (std::size_t c = 0; c < 3; ++c) {
      if (code[c] >= clip_threshold<std::uint8_t>())
        photo.clipped.data()[i] = static_cast<std::uint8_t>(photo.clipped.data()[i] | kBits[c]);
    }
  }
  return photo;
}

}  // namespace faceprobe::io
