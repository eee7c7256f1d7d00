#include "faceprobe/core/sky.h"

#include "faceprobe/core/angles.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace faceprobe {
namespace {

// Preetham et al. 1999, appendix A.2. Each of Perez's five terms is slope * turbidity + offset.
struct PerezTerms {
  std::array<double, 5> slope, offset;

  double term(std::size_t i, double turbidity) const { return slope[i] * turbidity + offset[i]; }
};
constexpr PerezTerms kLuminance{{0.1787, -0.3554, -0.0227, 0.1206, -0.0670}, {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}};
constexpr PerezTerms kX{{-0.0193, -0.0665, -0.0004, -0.0641, -0.0033}, {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}};
constexpr PerezTerms kY{{-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}, {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};
// Of the zenith's chromaticity: rows are powers 2, 1, 0 of the turbidity, columns powers 3 to 0 of the sun's zenith angle.
using ZenithTable = std::array<std::array<double, 4>, 3>;
constexpr ZenithTable kZenithX{
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr ZenithTable kZenithY{
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

constexpr double kLeastCosine = 1e-3;  // of the zenith angle in exp(B / cos): the term is 0 long before
constexpr double kLeastColour = 1e-3;  // of the luminance: no channel is black or below
constexpr int kGroundNside = 8;        // of the sum over the sky that lights the ground

double zenith_chromaticity(const ZenithTable& table, double turbidity, double sun_zenith) {
  double sum = 0;
  for (const std::array<double, 4>& row : table)
    sum = sum * turbidity + (((row[0] * sun_zenith) + row[1]) * sun_zenith + row[2]) * sun_zenith + row[3];
  return sum;
}

// One of the three quantities over the sky.
class Perez {
 public:
  Perez(const PerezTerms& terms, double turbidity, double at_zenith, double sun_zenith) {
    for (std::size_t i = 0; i < term_.size(); ++i) term_[i] = terms.term(i, turbidity);
    scale_ = at_zenith / shape(1, sun_zenith, std::cos(sun_zenith));
  }

  double operator()(double cos_zenith, double from_sun, double cos_from_sun) const {
    return scale_ * shape(cos_zenith, from_sun, cos_from_sun);
  }

 private:
  double shape(double cos_zenith, double from_sun, double cos_from_sun) const {
    return (1 + term_[0] * std::exp(term_[1] / std::max(cos_zenith, kLeastCosine))) *
           (1 + term_[2] * std::exp(term_[3] * from_sun) + term_[4] * cos_from_sun * cos_from_sun);
  }

  std::array<double, 5> term_{};
  double scale_ = 1;
};

// Linear Rec.709 of CIE xyY; its white is D65 (ITU-R BT.709).
Eigen::Vector3d rgb_from_xyy(double x, double y, double luminance) {
  static const Eigen::Matrix3d kFromXyz = (Eigen::Matrix3d() << 3.2409699, -1.5373832, -0.4986108, -0.9692436,
                                           1.8759675, 0.0415551, 0.0556301, -0.2039770, 1.0569715)
                                              .finished();
  const Eigen::Vector3d xyz(x / y * luminance, luminance, (1 - x - y) / y * luminance);
  return (kFromXyz * xyz).cwiseMax(kLeastColour * luminance);
}

// The sky alone, in units of 1000 cd/m2.
class Dome {
 public:
  explicit Dome(const SkyParameters& sky)
      : sun_(sun_direction(sky)), zenith_(radians(90 - sky.sun_elevation_deg)),
        luminance_(kLuminance, sky.turbidity, zenith_luminance(sky.turbidity, zenith_), zenith_),
        x_(kX, sky.turbidity, zenith_chromaticity(kZenithX, sky.turbidity, zenith_), zenith_),
        y_(kY, sky.turbidity, zenith_chromaticity(kZenithY, sky.turbidity, zenith_), zenith_) {}

  Eigen::Vector3d operator()(const Eigen::Vector3d& direction) const {
    const double cosine = std::clamp(direction.dot(sun_), -1.0, 1.0);
    const double angle = std::acos(cosine);
    return rgb_from_xyy(x_(direction.y(), angle, cosine), y_(direction.y(), angle, cosine),
                        luminance_(direction.y(), angle, cosine));
  }

  // On level ground.
  Eigen::Vector3d irradiance() const {
    static const SphereGrid kGrid(kGroundNside);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < kGrid.cell_count() / 2; ++j) {  // rings from the top
      const Eigen::Vector3d direction = kGrid.direction(j).cast<double>();
      if (direction.y() > 0) sum += direction.y() * (*this)(direction);
    }
    return kGrid.cell_solid_angle() * sum;
  }

 private:
  static double zenith_luminance(double turbidity, double sun_zenith) {
    const double chi = (4.0 / 9.0 - turbidity / 120.0) * (kPi - 2 * sun_zenith);
    return (4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192;
  }

  Eigen::Vector3d sun_;
  double zenith_;
  Perez luminance_, x_, y_;
};

bool within(double value, double low, double high) { return value >= low && value <= high; }

}  // namespace

std::string SkyParameters::validate() const {
  const auto wrong = [](const char* name, double value, const std::string& allowed) {
    return std::string("The sky's ") + name + " is " + std::to_string(value) + "; " + allowed + ".";
  };
  if (!std::isfinite(sun_azimuth_deg)) return wrong("sun_azimuth_deg", sun_azimuth_deg, "it must be a number");
  if (!within(sun_elevation_deg, 0, 90)) return wrong("sun_elevation_deg", sun_elevation_deg, "allowed is 0 to 90");
  if (!within(turbidity, kLeastTurbidity, kMostTurbidity)) return wrong("turbidity", turbidity, "allowed is 2 to 10");
  if (!(exposure > 0 && std::isfinite(exposure))) return wrong("exposure", exposure, "it must be above 0");
  if (!within(sun, 0, kMostSun)) return wrong("sun", sun, "allowed is 0 to 1000");
  if (!within(ground_albedo, 0, 1)) return wrong("ground_albedo", ground_albedo, "allowed is 0 to 1");
  return {};
}

Eigen::Vector3d sun_direction(const SkyParameters& sky) {
  return direction_from_angles(sky.sun_azimuth_deg, sky.sun_elevation_deg);
}

Eigen::Vector3d sun_irradiance(const SkyParameters& sky) {
  constexpr double kAboveTheAir = 128;  // klx, the solar illuminance constant; white
  const double zenith_deg = 90 - sky.sun_elevation_deg;
  const double air_mass = 1 / (std::cos(radians(zenith_deg)) + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
  constexpr std::array<double, 3> kWavelength = {0.61, 0.55, 0.46};  // micrometres: where the channels see most
  constexpr std::array<double, 3> kOzone = {12.0, 8.5, 0.6};         // per metre, there
  constexpr double kOzoneLayer = 0.0035;                             // metres
  const double haze = 0.04608 * sky.turbidity - 0.04586;             // Angstrom's
  Eigen::Vector3d light;
  for (int c = 0; c < 3; ++c) {
    const double wavelength = kWavelength[static_cast<std::size_t>(c)];
    const double depth = 0.008735 * std::pow(wavelength, -4.08) + haze * std::pow(wavelength, -1.3) +
                         kOzoneLayer * kOzone[static_cast<std::size_t>(c)];
    light[c] = kAboveTheAir * std::exp(-air_mass * depth);
  }
  return sky.exposure * sky.sun * light;
}

Eigen::MatrixX3f sky_radiance(const SkyParameters& sky, const SphereGrid& grid, const Eigen::Matrix3f& level_from_grid) {
  if (const std::string problem = sky.validate(); !problem.empty()) throw std::invalid_argument(problem);
  const Dome dome(sky);
  const Eigen::Vector3d sun = sun_direction(sky);
  const Eigen::Vector3d sunlight = sun_irradiance(sky);
  const Eigen::Vector3d ground =
      sky.ground_albedo / kPi * (sky.exposure * dome.irradiance() + std::max(0.0, sun.y()) * sunlight);
  Eigen::MatrixX3f out(grid.cell_count(), 3);
  for (int j = 0; j < grid.cell_count(); ++j) {
    const Eigen::Vector3d direction = (level_from_grid * grid.direction(j)).cast<double>().normalized();
    const Eigen::Vector3d radiance = direction.y() >= 0 ? Eigen::Vector3d(sky.exposure * dome(direction)) : ground;
    out.row(j) = radiance.transpose().cast<float>();
  }
  const SphereGrid::Interpolation around = grid.interpolate(level_from_grid.transpose() * sun.cast<float>());
  for (std::size_t i = 0; i < around.cell.size(); ++i) {
    const double share = static_cast<double>(around.weight[i]) / grid.cell_solid_angle();
    out.row(around.cell[i]) += (share * sunlight).transpose().cast<float>();
  }
  return out;
}

}  // namespace faceprobe
