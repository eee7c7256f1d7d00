#pragma once
// Lamps placed from several faces against synthetic groups whose lamps are known (`faceprobe synth --multi-face`): the paper's Sec. 5.4 on as
// many scenes as one likes; and groups under distant light alone, where no lamp is to be found.
//
//   const synth::ShardReader groups("groups");
//   const eval::ScoreTable scores = eval::measure_rooms(groups, look, {.samples = 100});
//   std::cout << scores.markdown("lamp_m", 2);

#include "faceprobe/eval/photo_input.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/lighting/triangulate.h"
#include "faceprobe/synth/shard.h"

#include <functional>
#include <vector>

namespace faceprobe::eval {

// The faces that a method sees in a photo, in any order: the point midway between the eyes, and the main lights. Empty: no face was found.
using LookAtGroup = std::function<std::vector<lighting::FaceLights>(const PhotoInput&)>;

struct RoomBenchmark {
  int samples = 100;  // spread evenly over the data set; those with fewer than two faces are left out
  lighting::TriangulateOptions triangulate = {};
  double near_m = 0.4;      // what counts as "within"
  double most_match_m = 2;  // a lamp that is found is one of the true ones if it is nearer than this
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

// Rows: one a photo and lamp, or face, methods "faces as found" and "faces known". Metrics: face_m (distance of a face from where it is, NaN
// where it was not found), face_found (1 or 0, of the faces shown), lamp_m (of a lamp, NaN where it was not found), found (1 or 0), within
// (1 where it was found and no further off than near_m, of all lamps), covered (1 where the stated ellipsoid of 95 % holds the truth, else
// 0), invented (near lamps in the photo that are none of the true ones), inventing (1 where there is such a one, else 0). Photos under distant
// light alone (`--lamps 0`) have the faces' metrics and the last two. Throws Error(kUsage) for options that do not validate.
ScoreTable measure_rooms(const synth::ShardReader& groups, const LookAtGroup& look, const RoomBenchmark& options);

}  // namespace faceprobe::eval
