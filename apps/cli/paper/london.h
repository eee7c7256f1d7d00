#pragma once
// How well the three studio lights of the London set come back from each of its people, and how far the estimates agree.
//
//   const LondonSet london = read_london(data / "real" / "portraits" / "london", 3);
//   const eval::ScoreTable scores = measure_london(london, {direction_setting(lighting::Solver::kTransport, {}, {})});
//   std::cout << scores.markdown_by_group("strongest_deg", "expression", 1);

#include "face_light_methods.h"
#include "faceprobe/eval/score_table.h"
#include "paper/direction_setting.h"
#include "paper/london_set.h"

#include <vector>

namespace faceprobe::cli {

// A row a photo and setting, and one of a light straight ahead. Metrics, all NaN unless both photos of the person have an answer:
//   strongest_deg           the strongest estimated light to the nearest true one
//   recall_deg              a true light to the nearest estimated one, mean
//   precision_deg           an estimated light to the nearest true one, mean
//   lights                  number of estimated ones
//   centroid_x, _y, _z      direction of the centroid of the light's energy, camera frame
//   centroid_off_deg        it to the mean of the setting's centroids
//   map_correlation         of the map with those of other people, mean: agreement_with_others(); not of a light that is the same for all
//   neutral_to_smiling_deg  between the person's two centroids; of smiling photos alone
// Groups: expression, and ethnicity where it is known. Intervals draw people.
// Rivals are given the first setting's estimates.
eval::ScoreTable measure_london(const LondonSet& london, const std::vector<DirectionSetting>& settings,
                                const PhotoDone& done = {}, const std::vector<FaceLightMethod>& rivals = {});

}  // namespace faceprobe::cli
