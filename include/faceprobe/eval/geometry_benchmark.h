#pragma once
// Normals and regions against synthetic photos whose surface is known.
//
//   const synth::ShardReader faces("faces/dev");
//   const std::vector<eval::GeometryMethod> methods = {eval::mesh_method(finder), ...};
//   const eval::GeometryScores scores = eval::measure_geometry(faces, methods, {.samples = 200});
//   std::cout << scores.table.markdown("normal", 1);

#include "faceprobe/core/image.h"
#include "faceprobe/core/region.h"
#include "faceprobe/eval/photo_input.h"
#include "faceprobe/eval/score_table.h"
#include "faceprobe/face/face.h"
#include "faceprobe/face/geometry.h"
#include "faceprobe/synth/shard.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace faceprobe::eval {

// Pictures of the input's size. Empty normals: the method found no face.
struct GeometryEstimate {
  Image normal_cam;        // 3 channels, unit, camera frame; 0 where the method has none
  Image normal_error_rad;  // 1 channel, what the method expects to be off by; may be empty
  ByteImage region;        // 1 channel, Region; may be empty
};

struct GeometryMethod {
  std::string name;
  std::function<GeometryEstimate(const PhotoInput&)> find;
};
// The dense face mesh, posed and rasterised: what the light is read from without a network. The finder must be used by nobody else
// meanwhile. Throws Error(kModel) when the mesh's file is missing.
GeometryMethod mesh_method(std::shared_ptr<const face::FaceFinder> finder);
// The same as mesh_method() with another surface, such as that of a fitted head model (pipeline/head_geometry.h).
GeometryMethod surface_method(std::string name, std::shared_ptr<const face::FaceFinder> finder, face::SurfaceFit fit);

struct GeometryBenchmark {
  int samples = 200;  // of as many people as possible; those that show less than 5 % skin are left out
  std::function<void(int done, int total)> progress = {};

  std::string validate() const;
};

// One of ten equal parts of all pixels, by the error that is stated.
struct CalibrationBin {
  double stated_deg = 0;  // means
  double true_deg = 0;
};

// True errors where a method trusts itself most and least: means over the third of the pixels that it states the least errors of, and the third
// with the largest.
struct TrustThirds {
  double best_deg = 0;
  double worst_deg = 0;
};
// Of bins that hold as many pixels each; one that lies across a border counts by its share. NaN without bins.
TrustThirds thirds_of(const std::vector<CalibrationBin>& bins);

struct GeometryScores {
  // Metrics of each row, degrees: normal and normal_median over the skin, normal_forehead, ... over parts of it that the photo shows at
  // least 20 pixels of. Only pixels count for which every method that found the face has a normal; where a method found none its figures
  // are NaN, which the table's texts count as missing. Groups: tone, turn (of the head).
  ScoreTable table;
  std::map<std::string, std::vector<CalibrationBin>> calibration;  // of methods that state an error
  // Intersection over union, over all photos in which the method found the face.
  std::map<std::string, std::array<double, kRegionCount>> region_overlap;
  std::map<std::string, double> skin_overlap;  // of the ten skin regions taken as one
  std::map<std::string, int> without_face;     // of every method: photos that its overlaps leave out

  double mean_overlap(const std::string& method) const;  // over the regions that there are
};

// Throws Error(kUsage) for options that do not validate.
GeometryScores measure_geometry(const synth::ShardReader& faces, const std::vector<GeometryMethod>& methods,
                                const GeometryBenchmark& options);

// Rows of photo, known normals and regions, and each method's, for looking at.
ByteImage draw_geometry(const synth::ShardReader& faces, const std::vector<GeometryMethod>& methods, int rows);

}  // namespace faceprobe::eval
