#include "train/open_shading.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/region.h"
#include "faceprobe/core/sh.h"
#include "faceprobe/core/sphere_grid.h"

#include <Eigen/Core>
#include <algorithm>

namespace faceprobe::train {
namespace {

constexpr int kOrder = 4;
constexpr int kTerms = sh::coefficient_count(kOrder);

// Texels of a map of one size to coefficients: what sh::project() multiplies by. A data set's maps are all of one size.
Eigen::MatrixXf coefficients_of_texels(int width, int height) {
  const EnvMap map(width, height);
  Eigen::MatrixXf terms(kTerms, width * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      terms.col(y * width + x) =
          (texel_solid_angle(y, width, height) * sh::basis(kOrder, map.direction(x, y).cast<double>())).cast<float>();
    }
  }
  return terms;
}

const SphereGrid& normals_grid() {
  static const SphereGrid grid(16);  // 3.7 degrees apart, interpolated
  return grid;
}

// Coefficients of radiance to irradiance / pi on the grid's directions.
const Eigen::MatrixXf& shading_of_coefficients() {
  static const Eigen::MatrixXf matrix = [] {
    Eigen::MatrixXf rows(normals_grid().cell_count(), kTerms);
    for (int j = 0; j < normals_grid().cell_count(); ++j) {
      Eigen::VectorXd terms = sh::basis(kOrder, normals_grid().direction(j).cast<double>());
      for (int band = 0; band <= kOrder; ++band)
        terms.segment(band * band, 2 * band + 1) *= sh::cosine_lobe(band) / kPi;
      rows.row(j) = terms.cast<float>().transpose();
    }
    return rows;
  }();
  return matrix;
}

bool on_face(Region region) { return is_skin(region) || region == Region::kEyes; }

}  // namespace

Image open_shading(const EnvMap& environment, const Image& normal, const ByteImage& region) {
  Image open(region.width(), region.height(), 3);
  const int width = environment.width();
  const int height = environment.height();
  if (width == 0) return open;
  // Remade where the size changes, which within a data set it does not.
  thread_local Eigen::MatrixXf of_texels;
  if (of_texels.cols() != width * height) of_texels = coefficients_of_texels(width, height);
  using Texels = Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>;
  const Eigen::MatrixX3f light = of_texels * Texels(environment.radiance().data(), width * height, 3);
  // Harmonics ring below 0 on the side away from a lamp.
  const Eigen::MatrixX3f shading = (shading_of_coefficients() * light).cwiseMax(0.0F);
  for (int y = 0; y < region.height(); ++y) {
    for (int x = 0; x < region.width(); ++x) {
      if (!on_face(static_cast<Region>(region(x, y)))) continue;
      const Eigen::Map<const Eigen::Vector3f> direction(normal.pixel(x, y));
      if (!(direction.squaredNorm() > 0)) continue;
      const SphereGrid::Interpolation around = normals_grid().interpolate(direction);
      Eigen::Map<Eigen::RowVector3f> value(open.pixel(x, y));
      for (std::size_t k = 0; k < around.cell.size(); ++k) value += around.weight[k] * shading.row(around.cell[k]);
    }
  }
  return open;
}

}  // namespace faceprobe::train
