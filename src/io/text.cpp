#include "faceprobe/io/text.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace faceprobe::io {
namespace {

std::optional<std::string> find_font(bool bold) {
  namespace fs = std::filesystem;
  const std::string file = bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf";
  for (const char* folder :
       {"/usr/share/fonts/truetype/dejavu", "/usr/share/fonts/dejavu-sans-fonts", "/usr/share/fonts/dejavu",
        "/usr/share/fonts/TTF", "/usr/local/share/fonts", "/usr/local/share/fonts/dejavu"}) {
    std::error_code error;
    fs::path candidate = fs::path(folder) / file;
    if (fs::is_regular_file(candidate, error)) return candidate.string();
  }
  return std::nullopt;
}

}  // namespace

bool draw_text(ByteImage& picture, int x, int y, const std::string& text, int height_px,
               const std::array<std::uint8_t, 3>& colour, bool bold) {
  if (picture.channels() != 3 || height_px < 1) {
    throw std::invalid_argument("draw_text wants a three-channel picture and a height of at least 1 px");
  }
  const std::optional<std::string> font = find_font(bold);
  if (!font) return false;
  if (text.empty() || picture.empty()) return true;
  OIIO::ImageBuf canvas(OIIO::ImageSpec(picture.width(), picture.height(), 3, OIIO::TypeDesc::UINT8), picture.data());
  const std::array<float, 3> ink = {static_cast<float>(colour[0]) / 255.0F, static_cast<float>(colour[1]) / 255.0F,
                                    static_cast<float>(colour[2]) / 255.0F};
  const bool drawn = OIIO::ImageBufAlgo::render_text(
      canvas, x, y, text, height_px, *font, OIIO::cspan<float>(ink.data(), 3), OIIO::ImageBufAlgo::TextAlignX::Left,
      OIIO::ImageBufAlgo::TextAlignY::Baseline, 0, OIIO::ROI(), 1);
  if (!drawn) canvas.geterror();  // left unread, it would be printed when the process ends
  return drawn;
}

}  // namespace faceprobe::io
