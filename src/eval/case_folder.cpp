#include "faceprobe/eval/case_folder.h"

#include "eval/case_notes.h"
#include "eval/case_picture.h"
#include "eval/case_pose.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

namespace faceprobe::eval {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostTextBytes = 64 << 10;
constexpr float kUnitTolerance = 0.01F;  // of a normal's length: half floats and resized pictures are not exact
constexpr std::array kCaseFiles = {"photo.png", "highlight.exr", "diffuse.exr", "normal.exr", "mask.png",
                                   "gt.hdr",    "gt.exr",        "pose.txt",    "case.json"};

[[noreturn]] void refuse_case(const std::string& sentence) { throw Error(ExitCode::kInput, sentence); }

// 8-bit PNG in sRGB as it is in the file.
ByteImage read_png(const fs::path& path, const io::Limits& limits) {
  const io::Photo picture = io::load_photo(path, limits);
  if (picture.format != "png" || picture.bits_per_channel != 8) {
    refuse_case(path.string() + " is " + picture.format + " of " + std::to_string(picture.bits_per_channel) +
                " bits; write it as PNG of 8 bits.");
  }
  if (!picture.colour_space.starts_with("sRGB")) {
    refuse_case(path.string() + " has the colour space '" + picture.colour_space + "'; convert it to sRGB.");
  }
  if (picture.exif_orientation != 1)
    refuse_case(path.string() + " is to be turned, as EXIF has it; write it upright, without that.");
  return encode_srgb(picture.linear);
}

// The first channel of a mask, which is grey.
ByteImage read_mask(const fs::path& path, const io::Limits& limits) {
  const ByteImage colour = read_png(path, limits);
  ByteImage mask(colour.width(), colour.height(), 1);
  for (std::size_t i = 0; i < mask.pixel_count(); ++i) mask.data()[i] = colour.data()[3 * i];
  return mask;
}

std::string text_of(const fs::path& path) { return io::read_text(path, kMostTextBytes); }

std::string layer_problem(const std::string& file, const Image& layer, const ByteImage& photo) {
  if (layer.empty()) return {};
  if (layer.channels() != 3) return file + " has " + std::to_string(layer.channels()) + " channels; 3 are wanted.";
  std::string problem = other_size(file, layer.width(), layer.height(), photo.width(), photo.height());
  if (problem.empty()) problem = not_finite(file, layer);
  return problem;
}

std::string normal_problem(const Image& normal) {
  for (int y = 0; y < normal.height(); ++y) {
    for (int x = 0; x < normal.width(); ++x) {
      const float length = Eigen::Map<const Eigen::Vector3f>(normal.pixel(x, y)).norm();
      if (length == 0 || std::abs(length - 1) <= kUnitTolerance) continue;
      return "normal.exr has a vector of length " + std::to_string(length) + " at column " + std::to_string(x) +
             ", row " + std::to_string(y) +
             "; normals have length 1, or 0 off the face, and are not encoded as colours.";
    }
  }
  return {};
}

std::string mask_problem(const ByteImage& mask, const ByteImage& photo) {
  if (mask.empty()) return {};
  if (mask.channels() != 1) return "mask.png has " + std::to_string(mask.channels()) + " channels; 1 is wanted.";
  std::string size = other_size("mask.png", mask.width(), mask.height(), photo.width(), photo.height());
  if (!size.empty()) return size;
  const auto odd = std::ranges::find_if(mask.values(), [](std::uint8_t value) { return value != 0 && value != 255; });
  if (odd != mask.values().end()) {
    return "mask.png holds the value " + std::to_string(*odd) +
           "; it is 255 where skin is judged, 0 elsewhere, nothing "
           "between.";
  }
  if (std::ranges::count(mask.values(), 255) == 0)
    return "mask.png is 0 everywhere; leave it out, or mark skin by 255.";
  return {};
}

std::string light_problem(const EnvMap& light) {
  for (std::string problem :
       {not_finite("gt", light.radiance()), negative("gt", light.radiance()), black("gt", light.radiance())}) {
    if (!problem.empty()) return problem;
  }
  return {};
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

}  // namespace

std::string Case::validate() const {
  if (photo.empty() || photo.channels() != 3) return "photo.png has no colour picture; 3 channels are wanted.";
  if (!light && highlight.empty())
    return "gt.hdr, gt.exr and highlight.exr are all missing; a case needs the true light or the true highlight layer.";
  for (std::string problem : {layer_problem("highlight.exr", highlight, photo), negative("highlight.exr", highlight),
                              layer_problem("diffuse.exr", diffuse, photo), negative("diffuse.exr", diffuse),
                              layer_problem("normal.exr", normal_cam, photo)}) {
    if (!problem.empty()) return problem;
  }
  for (std::string problem :
       {normal_cam.empty() ? std::string() : normal_problem(normal_cam), mask_problem(mask, photo),
        light ? light_problem(*light) : std::string(), pose ? pose_problem(*pose, "pose.txt") : std::string(),
        groups_problem(groups, "case.json")}) {
    if (!problem.empty()) return problem;
  }
  return {};
}

Case read_case(const fs::path& folder, const io::Limits& limits) {
  if (!is_folder(folder)) refuse_case(folder.string() + " is no folder; a case is a folder with a photo.png.");
  const auto there = [&](const char* name) { return fs::exists(folder / name); };
  const auto name_of = [&](const char* name) { return (folder / name).string(); };
  if (!there("photo.png"))
    refuse_case(name_of("photo.png") + " is missing; every folder there must be a case, which has a photo.");
  Case one;
  one.name = (folder.has_filename() ? folder : folder.parent_path()).filename().string();
  one.photo = read_png(folder / "photo.png", limits);
  const auto layer = [&](const char* name) {
    return there(name) ? read_numbers(folder / name, name_of(name), limits) : Image();
  };
  one.highlight = layer("highlight.exr");
  one.diffuse = layer("diffuse.exr");
  one.normal_cam = layer("normal.exr");
  if (there("mask.png")) one.mask = read_mask(folder / "mask.png", limits);
  if (const fs::path file = map_file(folder, "gt", folder.string()); !file.empty())
    one.light = read_case_map(file, file.string(), limits);
  if (there("pose.txt")) one.pose = pose_from_text(text_of(folder / "pose.txt"), name_of("pose.txt"));
  if (there("case.json")) read_notes(text_of(folder / "case.json"), name_of("case.json"), one);
  if (const std::string problem = one.validate(); !problem.empty()) refuse_case((folder / problem).string());
  return one;
}

std::vector<fs::path> case_folders(const fs::path& data) {
  if (!is_folder(data)) refuse_case(data.string() + " is no folder; name one that holds case folders.");
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(data)) {
    if (is_folder(entry.path()) && !entry.path().filename().string().starts_with('.')) folders.push_back(entry.path());
  }
  std::ranges::sort(folders);
  if (folders.empty()) refuse_case(data.string() + " holds no folder; every case is a folder of its own in there.");
  return folders;
}

std::string case_hash(const fs::path& folder, const io::Limits& limits) {
  std::string all;
  for (const char* name : kCaseFiles) {
    if (!fs::exists(folder / name)) continue;
    all += std::string(name) + ' ' + io::sha256_of_file(folder / name, limits.max_file_bytes) + '\n';
  }
  return io::sha256_hex(all);
}

CaseResult read_case_result(const fs::path& folder, int photo_width, int photo_height, const io::Limits& limits) {
  const auto clipped = [](Image& image) {
    for (float& value : image.values()) value = std::max(value, 0.0F);
  };
  const auto refuse_any = [](const std::string& problem) {
    if (!problem.empty()) refuse_case(problem);
  };
  CaseResult result;
  if (const fs::path file = map_file(folder, "map", "The method's folder"); !file.empty()) {
    const std::string name = file.filename().string();
    EnvMap light = read_case_map(file, name, limits);
    refuse_any(not_finite(name, light.radiance()));
    clipped(light.radiance());
    refuse_any(black(name, light.radiance()));
    result.light = std::move(light);
  }
  if (fs::exists(folder / "highlight.exr")) {
    result.highlight = read_numbers(folder / "highlight.exr", "highlight.exr", limits);
    refuse_any(
        other_size("highlight.exr", result.highlight.width(), result.highlight.height(), photo_width, photo_height));
    refuse_any(not_finite("highlight.exr", result.highlight));
    clipped(result.highlight);
  }
  if (!result.light && result.highlight.empty())
    refuse_case("Neither map.hdr, map.exr nor highlight.exr was written; one of them is wanted.");
  return result;
}

}  // namespace faceprobe::eval
