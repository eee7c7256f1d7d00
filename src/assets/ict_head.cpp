#include "faceprobe/assets/heads.h"

#include "assets/array.h"
#include "assets/finish_head.h"
#include "assets/ict_source.h"
#include "faceprobe/synth/skin_regions.h"

#include <array>
#include <cstddef>
#include <utility>

namespace faceprobe::assets {
namespace {

constexpr float kMetresPerCentimetre = 0.01F;

// Multi-PIE's 68 points on ICT-FaceKit's mesh (idx_to_landmark_verts of its vertex_indices.json).
constexpr std::array<int, 68> kLandmarks = {
    1225, 1888, 1052, 367,  1719, 1722, 2199, 1447, 966,  3661, 4390, 3927, 3924, 2608, 3272, 4088, 3443,  // jaw
    268,  493,  1914, 2044, 1401, 3615, 4240, 4114, 2734, 2509,                                            // brows
    978,  4527, 4942, 4857, 1140, 2075, 1147, 4269, 3360,                                                  // nose
    1507, 1542, 1537, 1528, 1518, 1511, 3742, 3751, 3756, 3721, 3725, 3732,                                // eyes
    5708, 5695, 2081, 0,    4275, 6200, 6213, 6346, 6461, 5518, 5957, 5841,                                // outer lips
    5702, 5711, 5533, 6216, 6207, 6470, 5517, 5966};                                                       // inner lips

enum IctRegion : int {
  kFace,
  kHeadAndNeck,
  kMouthSocket,
  kEyeSocketLeft,
  kEyeSocketRight,
  kGums,
  kTeethRow,
  kEyeLeft,
  kEyeRight,
  kUsed
};

synth::Material material_of(int region) {
  switch (region) {
    case kFace:
    case kHeadAndNeck:
    case kEyeSocketLeft:
    case kEyeSocketRight: return synth::Material::kSkin;
    case kEyeLeft:
    case kEyeRight: return synth::Material::kEye;
    case kTeethRow: return synth::Material::kTeeth;
    default: return synth::Material::kMouth;
  }
}

// Triangles of the regions in use, and the vertices up to the last one they name: the shells and lashes come after it.
synth::HeadModel take_parts(const IctSource& ict, const std::string& file) {
  synth::HeadModel model;
  model.name = "ict_facekit";
  model.uv_layout = synth::UvLayout::kIctFace;
  model.triangles.resize(ict.triangles.rows(), 3);
  model.triangle_uv.resize(ict.triangles.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < ict.triangles.rows(); ++t) {
    const int region = ict.triangle_region[static_cast<std::size_t>(t)];
    if (region < 0 || region >= kUsed) continue;
    model.triangles.row(count) = ict.triangles.row(t);
    model.triangle_uv.row(count++) = ict.triangle_uv.row(t);
    model.triangle_material.push_back(material_of(region));
  }
  model.triangles.conservativeResize(count, 3);
  model.triangle_uv.conservativeResize(count, 3);
  if (count == 0 || model.triangles.minCoeff() < 0 || model.triangles.maxCoeff() >= kIctVertices) {
    refuse_input(file + " has faces that name vertices it does not have.");
  }
  const Eigen::Index kept = std::max<Eigen::Index>(model.triangles.maxCoeff() + 1, kIctHeadVertices);
  model.neutral = ict.neutral.topRows(kept) * kMetresPerCentimetre;
  model.uv = ict.uv;
  return model;
}

std::vector<Eigen::MatrixX3f> take_modes(const std::vector<Eigen::MatrixX3f>& modes, Eigen::Index kept) {
  std::vector<Eigen::MatrixX3f> result;
  result.reserve(modes.size());
  for (const Eigen::MatrixX3f& mode : modes)
    result.emplace_back(mode.topRows(std::min(kept, mode.rows())) * kMetresPerCentimetre);
  return result;
}

// The vertices behind the skin that a mode of the skin alone leaves behind follow it in one piece: each eyeball as the mean of its
// lids, the mouth as the mean of the lips.
void carry_inner_parts(const IctSource& ict, synth::HeadModel& model) {
  std::vector<int> first_landmark(static_cast<std::size_t>(model.neutral.rows()), 48);
  for (Eigen::Index t = 0; t < ict.triangles.rows(); ++t) {
    const int region = ict.triangle_region[static_cast<std::size_t>(t)];
    const bool left = region == kEyeLeft || region == kEyeSocketLeft;
    if (!left && region != kEyeRight && region != kEyeSocketRight) continue;
    for (int corner = 0; corner < 3; ++corner)
      first_landmark[static_cast<std::size_t>(ict.triangles(t, corner))] = left ? 42 : 36;
  }
  for (Eigen::MatrixX3f& mode : model.identity) {
    const Eigen::Index moved = mode.rows();
    const auto mean_of = [&mode](int first, int last) -> Eigen::RowVector3f {
      Eigen::RowVector3f sum = Eigen::RowVector3f::Zero();
      for (int i = first; i < last; ++i) sum += mode.row(kLandmarks[static_cast<std::size_t>(i)]);
      return sum / static_cast<float>(last - first);
    };
    const Eigen::RowVector3f right_eye = mean_of(36, 42);
    const Eigen::RowVector3f left_eye = mean_of(42, 48);
    const Eigen::RowVector3f mouth = mean_of(48, 68);
    mode.conservativeResize(model.neutral.rows(), 3);
    for (Eigen::Index v = moved; v < mode.rows(); ++v) {
      const int first = first_landmark[static_cast<std::size_t>(v)];
      mode.row(v) = first == 36 ? right_eye : first == 42 ? left_eye : mouth;
    }
  }
}

}  // namespace

synth::HeadModel load_ict_head(const std::filesystem::path& folder) {
  const std::string name = quoted(folder);
  if (!has_ict_arrays(folder) && !has_ict_objs(folder)) {
    refuse_input(name + " is no ICT-FaceKit folder: it holds neither generic_neutral_mesh.obj nor ict_topology.npz.");
  }
  const IctSource ict = has_ict_arrays(folder) ? read_ict_arrays(folder) : read_ict_objs(folder);
  synth::HeadModel model = take_parts(ict, name);
  model.identity = take_modes(ict.identity, model.neutral.rows());
  model.expression = take_modes(ict.expression, model.neutral.rows());
  model.expression_names = ict.expression_names;
  model.landmarks.assign(kLandmarks.begin(), kLandmarks.end());
  const bool skin_alone = !model.identity.empty() && model.identity.front().rows() < model.neutral.rows();
  if (skin_alone) carry_inner_parts(ict, model);
  move_origin_between_eyes(model);
  model.vertex_region = synth::regions_from_landmarks(model);
  require_valid(model, name);
  return model;
}

}  // namespace faceprobe::assets
