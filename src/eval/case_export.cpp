#include "faceprobe/eval/case_export.h"

#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/region.h"
#include "faceprobe/eval/case_folder.h"

#include <string>

namespace faceprobe::eval {
namespace {

// Normals of the head without hair and what it wears, of length 1 again after half floats.
Image normals_of_face(const SyntheticPhoto& photo) {
  Image normals = photo.view.normal;
  for (std::size_t i = 0; i < normals.pixel_count(); ++i) {
    const auto region = static_cast<Region>(photo.view.region.data()[i]);
    Eigen::Map<Eigen::Vector3f> normal(normals.data() + 3 * i);
    const bool face = region != Region::kNone && region <= Region::kMouth && normal.norm() > 0.5F;
    normal = face ? Eigen::Vector3f(normal.normalized()) : Eigen::Vector3f::Zero();
  }
  return normals;
}

Case case_of(const SyntheticPhoto& photo) {
  Case one;
  one.photo = photo.sample.photo;
  one.highlight = photo.layers.highlight;
  one.diffuse = photo.layers.linear;
  for (std::size_t i = 0; i < one.diffuse.values().size(); ++i) {
    float& value = one.diffuse.data()[i];
    value = std::max(0.0F, value - one.highlight.data()[i]);
  }
  one.normal_cam = normals_of_face(photo);
  one.mask = photo.skin;
  for (std::uint8_t& value : one.mask.values()) value = value != 0 ? 255 : 0;
  one.light = photo.sample.environment;
  const Eigen::Isometry3f& head = photo.view.faces.at(0).camera_from_head;
  // Where no head was posed the data has the identity, which is where the camera is.
  if (head.translation().z() < 0) one.pose = {photo.input().camera, head.cast<double>()};
  one.groups = {{"person", photo.person}, {"tone", photo.tone()}};
  return one;
}

}  // namespace

std::string CaseExport::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

int export_cases(const synth::ShardReader& faces, const std::filesystem::path& folder, const CaseExport& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  int written = 0;
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    if (!photo.sample.lamps.empty()) return;  // a group's room: no one map lights it
    Case one = case_of(photo);
    if (options.scene) one.groups["scene"] = options.scene(photo.sample.map);
    one.licence = options.licence;
    const std::string digits = std::to_string(number);
    // Names in the order of the numbers.
    write_case(folder / (std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits), one);
    ++written;
  });
  return written;
}

}  // namespace faceprobe::eval
