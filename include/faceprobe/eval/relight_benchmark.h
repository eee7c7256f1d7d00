#pragma once
// Light estimates against synthetic photos whose light is known: the paper's Table 2 and the bunny figures of its supplement, on our faces.
//
//   const synth::ShardReader faces("faces/light");
//   const eval::LitObject bunny(assets::load_object("stanford-bunny.obj"));
//   const eval::RelightScores scores = eval::measure_relighting(faces, methods, bunny, {.samples = 100});
//   std::cout << scores.table.markdown("glossy", 1);
//
// The paper's own figures belong to other heads, maps and a bunny rendered by another program: they stand beside these, they do not compare.

#include "faceprobe/core/image.h"
#include "faceprobe/eval/lit_object.h"
#include "faceprobe/eval/photo_input.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/synth/shard.h"

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

namespace faceprobe::eval {

struct LightInput {
  int number = 0;  // of the photo in the data
  const PhotoInput& photo;
  // What the photo was made of: for the rows that show how good a method could be, and for no other.
  const synth::Sample& sample;
  const synth::ViewLayers& view;
};

struct LightMethod {
  std::string name;
  // Cells of the sphere grid x 3, camera frame, any scale. Empty: the method found nothing, and the photo counts as missing.
  std::function<Eigen::MatrixX3f(const LightInput&)> light;
};
// The same light from everywhere: what everything has to be better than.
LightMethod ambient_method(int nside = 16);
// The truth itself in spherical harmonics up to an order, what is below 0 cut off.
LightMethod harmonics_method(int order, int nside = 16);
// One light for every photo, the mean of many.
LightMethod constant_method(const std::string& name, Eigen::MatrixX3f light);
// Mean of the data's lights, each of the same energy, camera frame. `samples` of them, spread evenly.
Eigen::MatrixX3f mean_light(const synth::ShardReader& faces, int samples, int nside = 16);

struct RelightBenchmark {
  int samples = 100;  // of as many people as possible; those that show less than 5 % skin are left out
  int nside = 16;     // of the methods' sphere grid and the object's
  // The kind of scene that a map is of, "indoor" or "outdoor", by its number in the data; empty = not known.
  std::function<std::string(int map)> scene = {};
  int rows = 0;  // of photos in the picture
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

struct RelightScores {
  ScoreTable table;
  // For looking at: photo, then the object in the true light and in each method's, above the maps.
  ByteImage picture;
};

// Metrics (light_metrics.h): diffuse, glossy; si_diffuse, si_matte, si_mirror, angle_diffuse, nrmse_mirror and the like of the three spheres;
// nrmse_map, nrmse_map_truth; main_light and sun_centroid, sun_azimuth, sun_elevation (sun_metrics.h; degrees, of photos whose light is
// dominant); colour (degrees). Groups: tone, turn (of the head from the camera, degrees), clipped (share of the
// face's skin), size (of the face's skin in the crop), light ("one lamp",
// "several or soft"), and scene where it is known. Throws Error(kUsage) for options that do not validate.
RelightScores measure_relighting(const synth::ShardReader& faces, const std::vector<LightMethod>& methods,
                                 const LitObject& object, const RelightBenchmark& options);

}  // namespace faceprobe::eval
