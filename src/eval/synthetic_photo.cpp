#include "eval/synthetic_photo.h"

#include "eval/photo_choice.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/region.h"
#include "faceprobe/eval/skin_tone.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {

SyntheticPhoto::SyntheticPhoto(const synth::ShardReader& faces, int number)
    : sample(faces.copy_sample(number)), view(faces.copy_view(number)), layers(synth::photo_layers(sample)),
      face(synth::face_mask(view, 1.0F)), skin(synth::skin_mask(view)), person(person_key(faces, number)) {
  if (faces.has_meshes()) {
    synth::FoundMesh found = faces.copy_mesh(number);
    const auto on_skin = [](std::uint8_t region) { return is_skin(static_cast<Region>(region)); };
    const bool seen = std::ranges::any_of(found.region.values(), on_skin);
    std::ranges::transform(found.region.values(), face.values().begin(),
                           [&](std::uint8_t region) { return static_cast<std::uint8_t>(!seen || on_skin(region)); });
    mesh = std::move(found.normal_cam);
  }
  for (std::size_t i = 0; i < skin.values().size(); ++i) skin.data()[i] = skin.data()[i] & face.data()[i];
}

PhotoInput SyntheticPhoto::input() const {
  return {layers.linear,
          sample.photo,
          sample.clip,
          face,
          mesh,
          view.region,
          {.focal_px = static_cast<double>(view.focal_px),
           .centre_x_px = static_cast<double>(view.centre_px.x()),
           .centre_y_px = static_cast<double>(view.centre_px.y())}};
}

PhotoInput SyntheticPhoto::whole_input() const {
  const PhotoInput given = input();
  return {given.linear, given.photo, given.clip, no_mask_, no_mesh_, given.region, given.camera};
}

double SyntheticPhoto::skin_share() const {
  return static_cast<double>(std::count(skin.values().begin(), skin.values().end(), 1)) /
         static_cast<double>(skin.pixel_count());
}

bool SyntheticPhoto::enough_skin() const {
  constexpr double kLeastSkin = 0.05;
  return skin_share() >= kLeastSkin;
}

std::string SyntheticPhoto::tone() const {
  Eigen::Vector3d albedo = Eigen::Vector3d::Zero();
  double count = 0;
  for (std::size_t i = 0; i < skin.pixel_count(); ++i) {
    if (skin.data()[i] == 0) continue;
    albedo += Eigen::Map<const Eigen::Vector3f>(sample.albedo.data() + 3 * i).cast<double>();
    ++count;
  }
  return std::string(skin_tone_name(skin_tone(ita_deg(albedo / count))));
}

std::string SyntheticPhoto::turn() const {
  if (view.faces.empty()) return "unknown";
  const float forward = std::clamp(view.faces.front().camera_from_head.linear()(2, 2), -1.0F, 1.0F);
  const double angle = degrees(std::acos(static_cast<double>(forward)));
  return angle < 15 ? "under 15" : angle < 30 ? "15 to 30" : "30 and more";
}

std::string SyntheticPhoto::clipped() const {
  double clipped = 0;
  double count = 0;
  for (std::size_t i = 0; i < skin.pixel_count(); ++i) {
    if (skin.data()[i] == 0) continue;
    clipped += sample.clip.data()[i] != 0 ? 1 : 0;
    ++count;
  }
  const double share = clipped / count;
  return clipped_names()[share < 0.001 ? 0 : share < 0.05 ? 1 : 2];
}

std::string SyntheticPhoto::size() const {
  const double share = skin_share();
  return size_names()[share < 0.15 ? 0 : share < 0.25 ? 1 : 2];
}

void visit_photos(const synth::ShardReader& faces, const std::vector<int>& numbers,
                  const std::function<void(int, int)>& progress,
                  const std::function<void(int, const SyntheticPhoto&)>& visit) {
  int done = 0;
  for (const int number : numbers) {
    const SyntheticPhoto photo(faces, number);
    if (photo.enough_skin()) visit(number, photo);
    if (progress) progress(++done, static_cast<int>(numbers.size()));
  }
}

std::vector<std::string> tone_names() {
  std::vector<std::string> tones;
  tones.reserve(kSkinTones.size());
  for (const SkinTone tone : kSkinTones) tones.emplace_back(skin_tone_name(tone));
  return tones;
}

std::vector<std::string> turn_names() { return {"under 15", "15 to 30", "30 and more"}; }

std::vector<std::string> clipped_names() { return {"none", "under 5 %", "5 % and more"}; }

std::vector<std::string> size_names() { return {"under 15 %", "15 to 25 %", "25 % and more"}; }

}  // namespace faceprobe::eval
