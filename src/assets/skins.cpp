#include "faceprobe/assets/skins.h"

#include "assets/array.h"
#include "assets/folder.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/photo.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace faceprobe::assets {
namespace {

bool is_albedo(const std::string& name) {
  static constexpr std::array<std::string_view, 5> kOthers = {"coverage", "gloss", "bump", "normal", "mask"};
  return std::ranges::none_of(kOthers, [&](std::string_view other) { return name.find(other) != std::string::npos; });
}

}  // namespace

std::vector<std::pair<std::string, ByteImage>> load_skins(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, ByteImage>> skins;
  for (const std::filesystem::path& file : files_in(folder, {".jpg", ".jpeg", ".png"})) {
    if (is_albedo(file.stem().string()))
      skins.emplace_back(file.stem().string(), encode_srgb(io::load_photo(file).linear));
  }
  if (skins.empty()) refuse_input(quoted(folder) + " holds no .jpg or .png file; name a folder of skin textures.");
  return skins;
}

}  // namespace faceprobe::assets
