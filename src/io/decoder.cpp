#include "io/decoder.h"

#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"

#include <sys/mman.h>
#include <unistd.h>
#include <cstring>

namespace faceprobe::io {
namespace {

std::string reader_name(const std::string& format) { return format == "exr" ? "openexr" : format; }

// A nameless file in memory with these bytes, for libheif, which OpenImageIO lets read only by name. The decoder then sees
// the bytes that were checked, whatever happens to the file on disk.
int make_memory_file(std::span<const std::byte> bytes) {
  const int fd = ::memfd_create("faceprobe", MFD_CLOEXEC);
  while (fd >= 0 && !bytes.empty()) {
    const ssize_t done = ::write(fd, bytes.data(), bytes.size());
    if (done <= 0) {
      ::close(fd);
      return -1;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(done));
  }
  return fd;
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

}  // namespace

Decoder::Decoder(std::span<const std::byte> bytes, const Header& header, const std::string& name)
    : name_(name), memory_(bytes.data(), bytes.size()) {
  try {
    open(bytes, header);
  } catch (...) {
    if (memory_file_ >= 0) ::close(memory_file_);
    throw;
  }
}

std::vector<std::string> photo_formats() {
  std::vector<std::string> formats;
  for (const char* format : {"jpeg", "png", "tiff", "webp", "heif", "exr", "hdr"}) {
    if (OIIO::ImageInput::create(reader_name(format))) formats.emplace_back(format);
  }
  OIIO::geterror();  // of those that are not there; left unread, it would be printed when the process ends
  return formats;
}

Decoder::~Decoder() {
  reader_.reset();
  if (memory_file_ >= 0) ::close(memory_file_);
}

void Decoder::open(std::span<const std::byte> bytes, const Header& header) {
  reader_ = OIIO::ImageInput::create(reader_name(header.format));
  if (!reader_) {
    OIIO::geterror();  // left unread, it would be printed when the process ends
    throw Error(ExitCode::kInput, name_ + " is of a kind (" + header.format +
                                      ") that this build of OpenImageIO cannot read. Convert it to PNG or JPEG.");
  }
  std::string place = name_;
  if (reader_->supports("ioproxy")) {
    reader_->set_ioproxy(&memory_);
  } else {
    memory_file_ = make_memory_file(bytes);
    if (memory_file_ < 0) throw Error(ExitCode::kInput, name_ + " cannot be read: no memory for its bytes.");
    place = "/proc/self/fd/" + std::to_string(memory_file_);
  }
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // colour as stored; by default it comes back multiplied by alpha
  OIIO::ImageSpec ignored;
  if (!reader_->open(place, ignored, config)) refuse();
  check_against(header);
  choose_channels();
  const OIIO::TypeDesc format = spec().format;
  type_ = format.is_floating_point() ? CodeType::kFloat : format.size() == 1 ? CodeType::kByte : CodeType::kShort;
}

void Decoder::check_against(const Header& header) const {
  const OIIO::ImageSpec& s = spec();
  // A HEIF may be turned, or show a smaller item than the largest; every other kind has one size.
  const std::int64_t found = std::int64_t{s.width} * s.height;
  const bool same = header.format == "heif" ? found <= header.width * header.height
                                            : s.width == header.width && s.height == header.height;
  if (!same || s.width <= 0 || s.height <= 0 || s.depth > 1 || s.deep || s.nchannels < 1 ||
      s.nchannels > std::max(header.channels, 4)) {
    throw Error(ExitCode::kInput, name_ + " claims " + std::to_string(header.width) + " x " +
                                      std::to_string(header.height) + " px, but its decoder finds " +
                                      std::to_string(s.width) + " x " + std::to_string(s.height) +
                                      " px: it is damaged. Save it anew.");
  }
}

void Decoder::choose_channels() {
  const OIIO::ImageSpec& s = spec();
  const int red = s.channelindex("R");
  const int luma = s.channelindex("Y");
  if (red >= 0 && s.channelindex("G") == red + 1 && s.channelindex("B") == red + 2) {
    first_channel_ = red;
    colour_channels_ = 3;
  } else if (luma >= 0) {
    first_channel_ = luma;
    colour_channels_ = 1;
  } else {
    first_channel_ = 0;
    colour_channels_ = s.nchannels >= 3 ? 3 : 1;
  }
  const int next = first_channel_ + colour_channels_;
  has_alpha_ = next < s.nchannels && s.alpha_channel == next;
}

void Decoder::refuse() const {
  std::string reason = one_line(reader_->geterror());
  OIIO::geterror();
  throw Error(ExitCode::kInput, name_ + " cannot be decoded: " + (reason.empty() ? "it is damaged" : reason) +
                                    ". Copy it again or save it anew.");
}

void Decoder::read_tiled(const OIIO::TypeDesc& type) {
  whole_.resize(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()) *
                static_cast<std::size_t>(channels()) * type.size());
  if (!reader_->read_image(0, 0, first_channel_, first_channel_ + channels(), type, whole_.data())) refuse();
}

void Decoder::read(int first, int count, void* codes, const OIIO::TypeDesc& type) {
  const OIIO::ImageSpec s = reader_->spec_dimensions(0);
  if (s.tile_width > 0) {
    if (whole_.empty()) read_tiled(type);
    const std::size_t row = static_cast<std::size_t>(width()) * static_cast<std::size_t>(channels()) * type.size();
    std::memcpy(codes, whole_.data() + static_cast<std::size_t>(first) * row, static_cast<std::size_t>(count) * row);
    return;
  }
  const int y = s.y + first;
  if (!reader_->read_scanlines(0, 0, y, y + count, s.z, first_channel_, first_channel_ + channels(), type, codes))
    refuse();
}

}  // namespace faceprobe::io
