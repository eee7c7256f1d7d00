#include "assets/basel.h"

#include "assets/array.h"
#include "assets/finish_head.h"
#include "assets/mat_file.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::assets {
namespace {

constexpr float kMetresPerMicrometre = 1e-6F;

Eigen::MatrixX3f as_points(const Eigen::Ref<const Eigen::VectorXf>& column, float scale) {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(column.data(), column.size() / 3, 3) * scale;
}

}  // namespace

// 01_MorphableModel.mat (Paysan et al. 2009): x, y, z of the vertices in turn; the model's own script, coef2object.m, multiplies the
// columns of shapePC and texPC by shapeEV and texEV without a root, so EV are standard deviations. Shape in micrometres, +y up, +z
// out of the face; colour 0 .. 255, sRGB; tl counts from 1.
synth::HeadModel read_basel_2009(const std::filesystem::path& path) {
  const MatFile file(path);
  synth::HeadModel model;
  model.name = "basel_2009";
  const Eigen::VectorXf mean = file.vector("shapeMU");
  if (mean.size() == 0 || mean.size() % 3 != 0) {
    refuse_input(file.name() + ": 'shapeMU' holds " + std::to_string(mean.size()) +
                 " numbers, not points of three coordinates.");
  }
  model.neutral = as_points(mean, kMetresPerMicrometre);

  const Eigen::MatrixXf shapes = file.matrix("shapePC", mean.size());
  const Eigen::VectorXf deviations = file.vector("shapeEV", shapes.cols());
  for (Eigen::Index i = 0; i < shapes.cols(); ++i) {
    model.identity.push_back(as_points(shapes.col(i), kMetresPerMicrometre * deviations(i)));
  }

  set_encoded_albedo(model, as_points(file.vector("texMU", mean.size()), 1.0F / 255));
  const Eigen::MatrixXf colours = file.matrix("texPC", mean.size());
  const Eigen::VectorXf colour_deviations = file.vector("texEV", colours.cols());
  for (Eigen::Index i = 0; i < colours.cols(); ++i) {
    add_encoded_albedo_mode(model, as_points(colours.col(i), colour_deviations(i) / 255));
  }
  finish_albedo(model);

  const Eigen::MatrixXf corners = file.matrix("tl", -1, 3);
  if (corners.size() == 0 || corners.minCoeff() < 1 || corners.maxCoeff() > static_cast<float>(model.neutral.rows())) {
    refuse_input(file.name() + ": 'tl' names vertices outside 1 .. " + std::to_string(model.neutral.rows()) + ".");
  }
  model.triangles = corners.array().round().cast<int>() - 1;
  return model;
}

}  // namespace faceprobe::assets
