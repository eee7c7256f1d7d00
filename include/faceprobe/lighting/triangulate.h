#pragma once
// Lamps in the room: faces at different places see a near lamp in different directions, and where the directions meet it stands (Yi et al.
// 2018, Sec. 4.4). Which light of one face is which of another is told by colour, by how nearly the rays meet, by a third face that has to see
// the lamp where the first two put it, and by its strength, which falls with the square of the distance.
//
//   std::vector<lighting::FaceLights> faces = ...;      // position in metres, main lights, of each face
//   for (const lighting::Lamp& lamp : lighting::triangulate(faces, {})) {
//     if (lamp.near) use(lamp.position_m);               // else lamp.direction: too far away to say where
//   }
//
// Not for one face, and not for lamps that stand much further from the faces than these from one another: such a lamp is said to be distant.

#include "faceprobe/lighting/main_lights.h"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace faceprobe::lighting {

struct FaceLights {
  Eigen::Vector3d position_m;     // camera frame
  double position_error_m = 0.1;  // standard deviation along each axis
  std::vector<MainLight> lights;  // camera frame, strongest first; irradiances on one scale for all faces
};

struct TriangulateOptions {
  // Standard deviation of a light's direction. ESTIMATE, like least_gain chosen on the synthetic groups of docs/training.md: lights that are found near
  // a lamp are about so far off it.
  double direction_error_deg = 12;
  double log_strength_error = 0.5;  // standard deviation of the logarithm of its irradiance: skins are of unknown albedo
  double max_colour_deg = 12;       // between the colours of what may be one lamp
  double max_miss_deg = 20;         // of a face's light from where the lamp should be seen
  double least_m = 0.3, most_m = 20;  // of a lamp from each face that sees it
  // A lamp is near when that explains the lights so much better: least gain of the sum of squared deviations over a distant one.
  double least_gain = 2;

  std::string validate() const;
};

struct Sighting {
  int face = 0;
  int light = 0;  // in that face's lights
};

struct Lamp {
  bool near = false;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();     // camera frame; of near ones
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of the position, camera frame; of near ones
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();     // from the faces' middle to the lamp, unit; of all
  Eigen::Vector3d colour = Eigen::Vector3d::Ones();         // linear Rec.709, luminance 1
  double intensity = 0;        // near: irradiance times squared distance; distant: irradiance. In the faces' unit
  double miss_deg = 0;         // root mean square of the sightings' angles from where the lamp should be seen
  std::vector<Sighting> seen;  // at least two of different faces
};

// By falling number of faces that see them, then by strength. Lights that no other face sees are left out. Throws std::invalid_argument for
// options that do not validate.
std::vector<Lamp> triangulate(const std::vector<FaceLights>& faces, const TriangulateOptions& options = {});

}  // namespace faceprobe::lighting
