#include "faceprobe/core/sphere_grid.h"

#include "faceprobe/core/angles.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe {

namespace {

// Longitude from +z towards +x, in [0, 2 pi).
double longitude(const Eigen::Vector3d& d) {
  const double phi = std::atan2(d.x(), d.z());
  return phi < 0 ? phi + 2.0 * kPi : phi;
}

}  // namespace

SphereGrid::SphereGrid(int nside) : nside_(nside) {
  if (nside < 1 || nside > 512) throw std::invalid_argument("A sphere grid takes nside from 1 to 512.");
  directions_.resize(cell_count(), 3);
  for (int i = 0; i < ring_count(); ++i) {
    const Ring r = ring(i);
    const double radius = std::sqrt(std::max(0.0, 1.0 - r.height * r.height));
    for (int k = 0; k < r.length; ++k) {
      const double phi = r.first_phi + 2.0 * kPi * k / r.length;
      directions_.row(r.first + k) =
          Eigen::RowVector3d(radius * std::sin(phi), r.height, radius * std::cos(phi)).cast<float>();
    }
  }
}

SphereGrid SphereGrid::of_cells(Eigen::Index cells) {
  const auto nside = static_cast<int>(std::lround(std::sqrt(static_cast<double>(cells) / 12)));
  if (nside < 1 || static_cast<Eigen::Index>(12) * nside * nside != cells)
    throw std::invalid_argument("No sphere grid has " + std::to_string(cells) + " cells.");
  return SphereGrid(nside);
}

double SphereGrid::cell_solid_angle() const { return 4.0 * kPi / cell_count(); }

double SphereGrid::cell_radius() const { return std::acos(1.0 - cell_solid_angle() / (2.0 * kPi)); }

// Gorski et al. 2005, Eqs. 4 - 9 and their mirror image in the lower cap.
SphereGrid::Ring SphereGrid::ring(int index) const {
  const int n = nside_;
  const int i = index + 1;  // the paper counts rings from 1
  Ring r{};
  if (i < n || i > 3 * n) {
    const int k = i < n ? i : 4 * n - i;
    r.length = 4 * k;
    r.height = 1.0 - static_cast<double>(k) * k / (3.0 * n * n);
    r.first = i < n ? 2 * k * (k - 1) : cell_count() - 2 * k * (k + 1);
    if (i > n) r.height = -r.height;
    r.first_phi = kPi / (4.0 * k);
  } else {
    r.length = 4 * n;
    r.height = 4.0 / 3.0 - 2.0 * i / (3.0 * n);
    r.first = 2 * n * (n - 1) + (i - n) * 4 * n;
    r.first_phi = (i - n) % 2 == 0 ? kPi / (4.0 * n) : 0.0;  // every other ring is shifted by half a cell
  }
  return r;
}

// Gorski et al. 2005, section 5.1: cells are bounded by curves of constant (phi t +- height) in the equatorial belt and of
// constant (phi t) sqrt(1 - |height|) in the caps; counting the curves passed gives ring and place.
int SphereGrid::cell_of(const Eigen::Vector3f& direction) const {
  const Eigen::Vector3d d = direction.cast<double>().normalized();
  const double height = d.y();
  const double quarter = longitude(d) / (kPi / 2.0);  // [0, 4)
  const int n = nside_;
  if (std::abs(height) <= 2.0 / 3.0) {
    const double along = n * (0.5 + quarter);
    const double across = n * height * 0.75;
    const int ascending = static_cast<int>(std::floor(along - across));
    const int descending = static_cast<int>(std::floor(along + across));
    const int ring_from_top = n + 1 + ascending - descending;  // 1 .. 2n + 1
    const int shift = ring_from_top % 2 == 0 ? 1 : 0;
    int place = (ascending + descending - n + shift + 1) / 2;
    place = ((place % (4 * n)) + 4 * n) % (4 * n);
    return 2 * n * (n - 1) + (ring_from_top - 1) * 4 * n + place;
  }
  const double within = quarter - std::floor(quarter);
  const double spread = n * std::sqrt(3.0 * (1.0 - std::abs(height)));
  const int ascending = static_cast<int>(within * spread);
  const int descending = static_cast<int>((1.0 - within) * spread);
  const int k =
      std::min(n, ascending + descending + 1);  // ring from the nearer pole; rounding at the belt's edge may give n + 1
  int place = static_cast<int>(std::floor(quarter * k));
  place = std::clamp(place, 0, 4 * k - 1);
  return height > 0 ? 2 * k * (k - 1) + place : cell_count() - 2 * k * (k + 1) + place;
}

SphereGrid::Interpolation SphereGrid::interpolate(const Eigen::Vector3f& direction) const {
  const Eigen::Vector3d d = direction.cast<double>().normalized();
  const double phi = longitude(d);
  const double theta = std::acos(std::clamp(d.y(), -1.0, 1.0));
  // Rings are sorted by falling height: binary search for the first one below the direction.
  int low = 0;
  int high = ring_count();
  while (low < high) {
    const int middle = (low + high) / 2;
    if (ring(middle).height > d.y()) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  Interpolation out{};
  const auto along = [&](const Ring& r, std::size_t slot, double weight) {
    const double position = (phi - r.first_phi) / (2.0 * kPi) * r.length;
    const double floor = std::floor(position);
    const int k = ((static_cast<int>(floor) % r.length) + r.length) % r.length;
    const double fraction = position - floor;
    out.cell[slot] = r.first + k;
    out.cell[slot + 1] = r.first + (k + 1) % r.length;
    out.weight[slot] = static_cast<float>(weight * (1.0 - fraction));
    out.weight[slot + 1] = static_cast<float>(weight * fraction);
  };
  if (low == 0 || low == ring_count()) {
    // Inside a polar ring of four cells: between the ring's value at this longitude and the pole's, the mean of the four.
    const Ring r = ring(low == 0 ? 0 : ring_count() - 1);
    const double edge = std::acos(std::abs(r.height));
    const double from_pole = low == 0 ? theta : kPi - theta;
    const double weight = std::clamp(from_pole / edge, 0.0, 1.0);
    std::array<double, 4> weights;
    weights.fill(0.25 * (1.0 - weight));
    const double position = (phi - r.first_phi) / (2.0 * kPi) * r.length;
    const double floor = std::floor(position);
    const auto k = static_cast<std::size_t>(((static_cast<int>(floor) % 4) + 4) % 4);
    weights[k] += weight * (1.0 - (position - floor));
    weights[(k + 1) % 4] += weight * (position - floor);
    for (std::size_t i = 0; i < 4; ++i) {
      out.cell[i] = r.first + static_cast<int>(i);
      out.weight[i] = static_cast<float>(weights[i]);
    }
    return out;
  }
  const Ring above = ring(low - 1);
  const Ring below = ring(low);
  const double theta_above = std::acos(above.height);
  const double theta_below = std::acos(below.height);
  const double t = (theta - theta_above) / (theta_below - theta_above);
  along(above, 0, 1.0 - t);
  along(below, 2, t);
  return out;
}

}  // namespace faceprobe
