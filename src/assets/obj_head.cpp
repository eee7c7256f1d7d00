#include "assets/array.h"
#include "assets/finish_head.h"
#include "assets/obj_file.h"
#include "faceprobe/assets/heads.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/synth/skin_regions.h"

#include <cmath>
#include <utility>

namespace faceprobe::assets {
namespace {

float metres_per_unit(const Eigen::MatrixX3f& vertices) {
  const float height = vertices.col(1).maxCoeff() - vertices.col(1).minCoeff();
  if (height > 100) return 1e-3F;
  return height > 5 ? 1e-2F : 1.0F;
}

// A texture that the material names has to be there; one beside the file may be.
std::filesystem::path find_texture(const std::filesystem::path& path, const ObjFile& obj) {
  if (!obj.texture.empty()) {
    std::string name = obj.texture.string();
    for (char& c : name) c = c == '\\' ? '/' : c;  // written on Windows
    std::filesystem::path named = path.parent_path() / name;
    if (std::filesystem::exists(named)) return named;
    std::filesystem::path beside = path.parent_path() / std::filesystem::path(name).filename();
    if (std::filesystem::exists(beside)) return beside;
    refuse_input(quoted(path) + " names the texture " + quoted(named) + ", which is not there; put it beside the file.");
  }
  for (const char* extension : {".png", ".jpg", ".jpeg"}) {
    std::filesystem::path beside = path;
    beside.replace_extension(extension);
    if (std::filesystem::exists(beside)) return beside;
  }
  return {};
}

}  // namespace

synth::HeadModel load_obj_head(const std::filesystem::path& path, const ObjHeadOptions& options) {
  if (!std::isfinite(options.units_m) || options.units_m < 0) {
    throw Error(ExitCode::kUsage, "A unit of " + quoted(path) + " cannot be " + std::to_string(options.units_m) +
                                      " metres; a number above 0, or 0 for a guess, is allowed.");
  }
  ObjFile obj = read_obj(path);
  synth::HeadModel model;
  model.name = path.stem().string();
  model.neutral = obj.vertices * (options.units_m > 0 ? options.units_m : metres_per_unit(obj.vertices));
  model.triangles = std::move(obj.triangles);
  make_all_skin(model);
  if (obj.uv.rows() > 0) {
    model.uv = std::move(obj.uv);
    model.triangle_uv = std::move(obj.triangle_uv);
    model.uv_layout = synth::UvLayout::kOwn;
    const std::filesystem::path texture = find_texture(path, obj);
    if (!texture.empty()) model.texture = encode_srgb(io::load_photo(texture).linear);
  }
  read_landmarks_beside(path, model);
  move_origin_between_eyes(model);
  model.vertex_region = synth::regions_from_landmarks(model);
  require_valid(model, quoted(path));
  return model;
}

}  // namespace faceprobe::assets
