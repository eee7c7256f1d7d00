#pragma once
// Internal: several people in one room, and lamps in it. Scene frame: metres, +y up, the usual camera at the origin looking along -z.

#include "faceprobe/synth/light_sample.h"
#include "faceprobe/synth/person.h"

#include <span>
#include <vector>

namespace faceprobe::synth {

inline constexpr int kFewestPeople = 2, kMostPeople = 4;  // of a group

// The people of a scene: one in the head's own frame, or for Recipe::multi_face two to four (Recipe::people of them) from left to right, placed in
// the scene.
std::vector<Person> draw_people(const Assets& assets, const Recipe& recipe, int number);

// Where the camera stands and looks: at a lone person as draw_view() has it; for a group so that every face is in the picture.
View draw_scene_view(std::span<const Person> people, const Recipe& recipe, int number, int view);

// One to three lamps, or Recipe::lamps of them, that the camera does not see, scene frame; together they give the group about the irradiance 1.
// Where the recipe asks for neither a number nor a distance there may be fewer than were drawn, or none: some groups leave no place. Else throws
// Error(kUsage) when there is no place for them all.
std::vector<NearLight> draw_lamps(std::span<const Person> people, const PinholeCamera& camera, const Recipe& recipe,
                                  Random& random);

}  // namespace faceprobe::synth
