#include "faceprobe/synth/person.h"

#include "faceprobe/core/angles.h"
#include "synth/generate/turn.h"

#include <algorithm>

namespace faceprobe::synth {
namespace {

enum Purpose : std::uint64_t { kShape = 1, kExpression, kSkins, kClothes, kEyes, kCamera };

std::uint64_t number_of(Split split) { return static_cast<std::uint64_t>(split); }

Random person_random(const Recipe& recipe, int number) {
  return Random({recipe.seed, number_of(recipe.split), static_cast<std::uint64_t>(number)});
}

constexpr int kDevEvery = 6;  // one texture in six is kept for development sets

std::vector<int> allowed_textures(const Assets& assets, Split split) {
  std::vector<int> allowed;
  for (int i = 0; i < static_cast<int>(assets.skins.size()); ++i) {
    const bool dev = i % kDevEvery == kDevEvery - 1;
    if (split == Split::kAll || dev == (split == Split::kDev)) allowed.push_back(i);
  }
  return allowed;
}

Eigen::Vector3f draw_iris(Random& random) {
  static const std::array<Eigen::Vector3f, 6> kColours = {{
      {0.020F, 0.010F, 0.006F},  // dark brown
      {0.050F, 0.022F, 0.010F},  // brown
      {0.110F, 0.060F, 0.022F},  // hazel
      {0.090F, 0.095F, 0.040F},  // green
      {0.090F, 0.130F, 0.180F},  // blue
      {0.140F, 0.150F, 0.160F},  // grey
  }};
  // Brown eyes are most of mankind's.
  static constexpr std::array<double, 6> kUpTo = {0.40, 0.70, 0.80, 0.86, 0.96, 1.0};
  const double pick = random.uniform();
  const auto index = static_cast<std::size_t>(std::ranges::upper_bound(kUpTo, pick) - kUpTo.begin());
  return kColours[std::min<std::size_t>(index, 5)] * static_cast<float>(random.between(0.8, 1.25));
}

// Middle of the features: between brows and chin, where a photographer aims.
Eigen::Vector3f face_centre(const Head& head) {
  if (head.landmarks.rows() == 68) return head.landmarks.colwise().mean().transpose();
  return {0.0F, -0.035F, 0.0F};
}

// Brows to chin.
float face_height(const Head& head) {
  if (head.landmarks.rows() == 68) {
    return std::max(0.05F, head.landmarks.middleRows(17, 10).col(1).mean() - head.landmarks(8, 1));
  }
  return 0.125F;
}

}  // namespace

Person draw_person(const Assets& assets, const Recipe& recipe, int number) {
  const Random root = person_random(recipe, number);
  Person person;
  person.number = number;
  Random shape = root.split(kShape);
  person.head_model = shape.below(static_cast<int>(assets.heads.size()));
  const HeadModel& model = assets.heads[static_cast<std::size_t>(person.head_model)];
  person.parameters = draw_identity(model, {}, shape);
  if (recipe.mode == Mode::kDefault) {
    Random face = root.split(kExpression);
    person.parameters.expression = draw_expression(model, {}, face);
  } else {
    person.parameters.expression = Eigen::VectorXf::Zero(static_cast<Eigen::Index>(model.expression.size()));
  }
  person.head = make_head(model, person.parameters);

  const std::vector<int> textures =
      model.uv_layout == UvLayout::kIctFace ? allowed_textures(assets, recipe.split) : std::vector<int>{};
  Random skins = root.split(kSkins);
  for (int i = 0; i < recipe.skins_per_person; ++i) {
    const int count = static_cast<int>(textures.size());
    SkinSettings skin = recipe.mode == Mode::kPaper
                            ? draw_paper_skin(count, skins)
                            : draw_skin(count, skins, assets.reflectance ? &*assets.reflectance : nullptr);
    skin.texture = skin.texture >= 0 && skin.texture < count ? textures[static_cast<std::size_t>(skin.texture)] : -1;
    person.skins.push_back(skin);
  }

  if (model.uv_layout == UvLayout::kOwn && !model.texture.empty())
    person.own_texture = prepare_texture(model.name, model.texture);

  person.figures.push_back(person.head.figure);
  if (recipe.mode == Mode::kDefault) {
    Random clothes = root.split(kClothes);
    person.wardrobe = draw_wardrobe(clothes);
    person.wardrobe.skin_tone = person.skins.front().target_tone;
    for (SkinSettings& skin : person.skins) skin.hair_colour = person.wardrobe.hair_colour;
    person.figures.push_back(dress(person.head, person.wardrobe));
  }

  Random eyes = root.split(kEyes);
  person.eyes = find_eyeballs(person.head);
  const Eigen::Vector3f iris = draw_iris(eyes);
  for (Eyeball& eye : person.eyes) eye.iris_colour = iris;
  return person;
}

View draw_view(const Person& person, const Recipe& recipe, int view) {
  Random random = person_random(recipe, person.number).split(kCamera).split(static_cast<std::uint64_t>(view));
  // Most people look near the camera; the rest is spread evenly, so that networks see profiles too.
  const bool wide = random.chance(0.4);
  const double yaw = wide ? random.between(radians(-55), radians(55)) : random.normal(0, radians(13));
  const double pitch = random.normal(radians(2), radians(9));
  const double roll = random.normal(0, radians(6));
  const double distance_m = random.log_between(0.3, 3.0);
  const double share = random.between(0.40, 0.62);  // of the picture's height, brows to chin

  View result;
  result.camera.width_px = result.camera.height_px = recipe.size_px;
  const auto size = static_cast<double>(recipe.size_px);
  result.camera.focal_px = static_cast<float>(share * size * distance_m / static_cast<double>(face_height(person.head)));
  result.camera.centre_px = Eigen::Vector2f::Constant(static_cast<float>(size / 2));
  const Eigen::Matrix3f rotation =
      turn(std::clamp(yaw, radians(-60), radians(60)), std::clamp(pitch, radians(-25), radians(25)),
           std::clamp(roll, radians(-20), radians(20)));
  const double metres_per_px = distance_m / static_cast<double>(result.camera.focal_px);
  const Eigen::Vector3f aim(static_cast<float>(random.normal(0, 0.025) * size * metres_per_px),
                            static_cast<float>(random.normal(0, 0.025) * size * metres_per_px),
                            static_cast<float>(-distance_m));
  result.camera.camera_from_scene.linear() = rotation;
  result.camera.camera_from_scene.translation() = aim - rotation * face_centre(person.head);
  result.camera_from_level = turn(0, random.normal(0, radians(6)), random.normal(0, radians(3)));
  return result;
}

}  // namespace faceprobe::synth
