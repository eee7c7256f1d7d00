#pragma once
// Highlight separators on objects whose diffuse layer was photographed through polarisers, beside published figures. Code values / 255 are fed
// as they are, whatever their encoding: that is what the published figures were computed on. Our network needs a face and has no place here.
//
//   const std::vector<ObjectPicture> pictures = object_pictures(data / "real" / "specsep_objects");
//   const eval::ScoreTable scores = measure_objects(pictures, {});
//   std::cout << scores.markdown("psnr_diffuse", 1);

#include "faceprobe/eval/score_table.h"
#include "faceprobe/highlight/separate.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::cli {

inline constexpr std::array<highlight::Separator, 3> kObjectSeparators = {
    highlight::Separator::kTan, highlight::Separator::kYang, highlight::Separator::kShen};

// Folders below real/specsep_objects: Shen & Zheng 2013 (8-bit pictures), Grosse et al. 2009 (16-bit linear pictures on black).
inline constexpr std::array<const char*, 2> kObjectSets = {"shen", "mit"};

struct ObjectPicture {
  std::string set, name;
  std::filesystem::path picture, diffuse;
  // PSNR of the diffuse layer, dB, of kObjectSeparators as the SIHR collection prints it.
  std::optional<std::array<double, 3>> published = {};
};
// Those of the sets that are there.
std::vector<ObjectPicture> object_pictures(const std::filesystem::path& folder);

// Values as the file has them, scaled to [0, 1]; three channels. Throws Error(kInput).
Image read_code_values(const std::filesystem::path& path);

struct ObjectLayers {
  Image picture, diffuse, highlight;  // highlight: picture - diffuse, noise below 0 taken off
  std::array<Image, kObjectSeparators.size()> found_highlights{};  // of kObjectSeparators
};

struct ObjectBenchmark {
  int threads = 0;
  int repeats = 1;                                                                      // of which the fastest counts
  std::function<void(const ObjectPicture& of, const ObjectLayers& layers)> visit = {};  // after each picture
};

// A row a picture and separator, and one of "black layer", which takes the whole picture for diffuse. Metrics, over all pixels and channels:
// psnr_diffuse (dB, both rounded to 8 bits; infinite where they are the same), rmse_highlight (0-255), ssim_highlight; of separators also seconds,
// and published (dB) where it is. Groups: set, picture and pixels ("640 x 480"). Throws Error(kInput).
eval::ScoreTable measure_objects(const std::vector<ObjectPicture>& pictures, const ObjectBenchmark& options);

struct TimedLayers {
  highlight::Layers layers;
  double seconds = 0;  // of the fastest run: the others shared the processor
};
TimedLayers timed_separation(const Image& picture, highlight::Separator separator, const ObjectBenchmark& options);

}  // namespace faceprobe::cli
