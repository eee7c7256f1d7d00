#pragma once
// One open picture in memory: hands out rows of native code values. The reader is chosen by the content (Header::format), so
// a TIFF named .jpg decodes as a TIFF.

#include "io/header_peek.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faceprobe::io {

enum class CodeType { kByte, kShort, kFloat };

class Decoder {
 public:
  // The bytes must outlive the decoder. Throws Error(kInput) when the reader refuses them, or reads another picture than the
  // header promised.
  Decoder(std::span<const std::byte> bytes, const Header& header, const std::string& name);
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;
  ~Decoder();

  int width() const { return spec().width; }
  int height() const { return spec().height; }
  CodeType type() const { return type_; }
  int colour_channels() const { return colour_channels_; }  // 1 or 3
  bool has_alpha() const { return has_alpha_; }             // then alpha follows the colour in every pixel
  int channels() const { return colour_channels_ + (has_alpha_ ? 1 : 0); }
  const OIIO::ImageSpec& spec() const { return reader_->spec(); }

  // Rows [first, first + count), each width * channels() values of the type. Cheapest in order from the top.
  void read_rows(int first, int count, std::uint8_t* codes) { read(first, count, codes, OIIO::TypeDesc::UINT8); }
  void read_rows(int first, int count, std::uint16_t* codes) { read(first, count, codes, OIIO::TypeDesc::UINT16); }
  void read_rows(int first, int count, float* codes) { read(first, count, codes, OIIO::TypeDesc::FLOAT); }

 private:
  void open(std::span<const std::byte> bytes, const Header& header);
  void choose_channels();
  void check_against(const Header& header) const;
  void read(int first, int count, void* codes, const OIIO::TypeDesc& type);
  void read_tiled(const OIIO::TypeDesc& type);
  [[noreturn]] void refuse() const;

  std::string name_;
  OIIO::Filesystem::IOMemReader memory_;
  int memory_file_ = -1;
  std::unique_ptr<OIIO::ImageInput> reader_;
  CodeType type_ = CodeType::kByte;
  int first_channel_ = 0;
  int colour_channels_ = 3;
  bool has_alpha_ = false;
  std::vector<std::byte> whole_;  // a tiled picture, decoded at once
};

}  // namespace faceprobe::io
