#include "faceprobe/assets/maps.h"

#include "assets/array.h"
#include "assets/folder.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/picture_file.h"
#include "io/decoder.h"

#include <cmath>

namespace faceprobe::assets {
namespace {

// The reader takes what is not finite for 0. A photo may have such pixels; in a map to train with they are a mistake, and the sun is
// where they are found. Radiance's .hdr cannot hold any.
void require_finite(const std::filesystem::path& path) {
  const io::Limits limits;
  const std::vector<std::byte> bytes = io::read_file(path, limits.max_file_bytes);
  const io::Header header = io::accept_header(bytes, path.string(), limits);
  if (header.format != "exr") return;
  io::Decoder decoder(bytes, header, path.string());
  std::vector<float> row(static_cast<std::size_t>(decoder.width()) * static_cast<std::size_t>(decoder.channels()));
  for (int y = 0; y < decoder.height(); ++y) {
    decoder.read_rows(y, 1, row.data());
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (std::isfinite(row[i])) continue;
      refuse_input(quoted(path) + " holds " + (std::isnan(row[i]) ? "NaN" : "infinity") + " at column " +
                   std::to_string(i / static_cast<std::size_t>(decoder.channels())) + ", row " + std::to_string(y) +
                   "; a map must be finite. Repair the texel from its neighbours.");
    }
  }
}

}  // namespace

std::vector<std::pair<std::string, EnvMap>> load_maps(const std::filesystem::path& folder) {
  std::vector<std::pair<std::string, EnvMap>> maps;
  for (const std::filesystem::path& file : files_in(folder, {".hdr", ".exr"})) {
    require_finite(file);
    maps.emplace_back(file.stem().string(), io::read_env_map(file));
  }
  if (maps.empty()) refuse_input(quoted(folder) + " holds no .hdr or .exr file; name a folder of environment maps.");
  return maps;
}

}  // namespace faceprobe::assets
