#pragma once
// Internal: the picture of a relighting benchmark.

#include "faceprobe/core/image.h"
#include "faceprobe/core/sphere_grid.h"
#include "faceprobe/eval/lit_object.h"

#include <Eigen/Core>

namespace faceprobe::eval {

// Rows of photo, truth, one column a method; each light as the glossy object over its map, both divided by its own diffuse maximum.
class RelightSheet {
 public:
  RelightSheet(const LitObject& object, const SphereGrid& grid, int rows, int methods);

  // Whether photo number `visited` of about `total` gets a row.
  bool takes(int visited, int total) const;
  void begin_row(const ByteImage& photo, const Eigen::MatrixX3f& truth);
  void add(const Eigen::MatrixX3f& light);  // the next column; an empty light leaves it black
  // Rows that were begun; empty when there were none.
  ByteImage picture() const;

 private:
  void put(const ByteImage& cell, int column, int top);

  const LitObject& object_;
  const SphereGrid& grid_;
  int rows_, columns_;
  int side_;  // of a cell; the map below is half as high
  int row_ = -1, column_ = 0;
  ByteImage sheet_;
};

}  // namespace faceprobe::eval
