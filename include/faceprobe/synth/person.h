#pragma once
// Somebody to take pictures of: a head with its expression, skins, hair and clothes, and where the camera stands. All drawn from a seed
// and a number, so that person 17 of seed 1 is the same whoever asks.
//
//   const Person person = draw_person(assets, recipe, 17);
//   const Scene scene(person.figures);
//   const View view = draw_view(person, recipe, 17, 0);

#include "faceprobe/synth/assets.h"
#include "faceprobe/synth/fragments.h"
#include "faceprobe/synth/head_model.h"
#include "faceprobe/synth/recipe.h"
#include "faceprobe/synth/skin.h"
#include "faceprobe/synth/wardrobe.h"

#include <optional>
#include <vector>

namespace faceprobe::synth {

// An eyeball's middle and where it looks, head frame; for iris and pupil.
struct Eyeball {
  Eigen::Vector3f centre{0, 0, 0};  // metres
  Eigen::Vector3f gaze{0, 0, 1};    // unit, out of the eye
  float radius_m = 0.012F;
  Eigen::Vector3f iris_colour{0.1F, 0.06F, 0.04F};  // albedo, linear
};

struct Person {
  int number = 0;
  int head_model = 0;  // in the assets
  HeadParameters parameters;
  Head head;                        // head frame
  std::vector<Figure> figures;      // the head with all that it wears
  std::vector<SkinSettings> skins;  // Recipe::skins_per_person
  WardrobeSettings wardrobe;
  std::vector<Eyeball> eyes;
  std::optional<SkinTexture> own_texture;  // of a head model with UVs and a texture of its own

  // Where the person is in a scene: figures (first_figure and those after it there) are in the scene's frame, the rest in the head's.
  Eigen::Isometry3f scene_from_head = Eigen::Isometry3f::Identity();
  int first_figure = 0;

  // Whether the scene's figure of that number is one of this person's.
  bool owns_figure(int figure) const {
    return figure >= first_figure && figure < first_figure + static_cast<int>(figures.size());
  }
};
// `number`: from 0.
Person draw_person(const Assets& assets, const Recipe& recipe, int number);

struct View {
  PinholeCamera camera;               // its scene is the head frame
  Eigen::Matrix3f camera_from_level;  // the camera's tilt: level has +y up
};
// `view`: from 0.
View draw_view(const Person& person, const Recipe& recipe, int view);

// Centre, radius and axis of each eyeball of a head: the cornea, its farthest bulge, says where it looks.
std::vector<Eyeball> find_eyeballs(const Head& head);

}  // namespace faceprobe::synth
