#include "faceprobe/core/sh.h"

#include "faceprobe/core/angles.h"

#include <cmath>

namespace faceprobe::sh {

namespace {

int index_of(int band, int m) { return band * (band + 1) + m; }

}  // namespace

Eigen::VectorXd basis(int order, const Eigen::Vector3d& direction) {
  // Associated Legendre values divided by sin^m, times the real and imaginary part of (x + iy)^m: no trigonometry and
  // nothing singular at the poles.
  const double z = direction.z();
  Eigen::VectorXd values(coefficient_count(order));
  double cosine = 1.0;  // Re (x + iy)^m = sin^m(theta) cos(m phi)
  double sine = 0.0;
  double diagonal = std::sqrt(0.25 / kPi);  // normalised P_m^m / sin^m
  for (int m = 0; m <= order; ++m) {
    double before = 0.0;
    double current = diagonal;
    for (int band = m; band <= order; ++band) {
      const double scale = m == 0 ? 1.0 : std::sqrt(2.0);
      values[index_of(band, m)] = scale * current * cosine;
      if (m > 0) values[index_of(band, -m)] = scale * current * sine;
      const double next = band + 1;
      const double a = std::sqrt((4.0 * next * next - 1.0) / (next * next - m * m));
      const double b = std::sqrt(((next - 1.0) * (next - 1.0) - m * m) / (4.0 * (next - 1.0) * (next - 1.0) - 1.0));
      const double following = a * (z * current - (band == m ? 0.0 : b * before));
      before = current;
      current = following;
    }
    diagonal *= std::sqrt((2.0 * m + 3.0) / (2.0 * m + 2.0));
    const double turned = cosine * direction.x() - sine * direction.y();
    sine = cosine * direction.y() + sine * direction.x();
    cosine = turned;
  }
  return values;
}

Eigen::MatrixX3d project(const EnvMap& map, int order) {
  Eigen::MatrixX3d coefficients = Eigen::MatrixX3d::Zero(coefficient_count(order), 3);
  for (int y = 0; y < map.height(); ++y) {
    const double solid_angle = texel_solid_angle(y, map.width(), map.height());
    for (int x = 0; x < map.width(); ++x) {
      const Eigen::VectorXd values = basis(order, map.direction(x, y).cast<double>());
      const Eigen::Vector3d radiance = Eigen::Map<const Eigen::Vector3f>(map.radiance().pixel(x, y)).cast<double>();
      coefficients.noalias() += (solid_angle * values) * radiance.transpose();
    }
  }
  return coefficients;
}

double cosine_lobe(int band) {
  // Ramamoorthi & Hanrahan 2001, Eq. 8; multiplied by sqrt(4 pi / (2l + 1)) already.
  if (band == 0) return kPi;
  if (band == 1) return 2.0 * kPi / 3.0;
  if (band % 2 == 1) return 0.0;
  const double half = band / 2.0;
  const double sign = (band / 2) % 2 == 1 ? 1.0 : -1.0;
  const double log_ratio = std::lgamma(band + 1.0) - 2.0 * std::lgamma(half + 1.0) - band * std::log(2.0);
  return 2.0 * kPi * sign / ((band + 2.0) * (band - 1.0)) * std::exp(log_ratio);
}

Eigen::Vector3d irradiance(const Eigen::MatrixX3d& radiance, const Eigen::Vector3d& normal) {
  const int order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(radiance.rows())))) - 1;
  const Eigen::VectorXd values = basis(order, normal);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int band = 0; band <= order; ++band) {
    const int first = index_of(band, -band);
    const int count = 2 * band + 1;
    sum += cosine_lobe(band) * radiance.middleRows(first, count).transpose() * values.segment(first, count);
  }
  return sum;
}

}  // namespace faceprobe::sh
