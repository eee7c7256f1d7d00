// Two layers by Kubelka & Munk (1931): an epidermis 60 um thick with melanin over a thick dermis with blood.
//
// Absorption: melanosomes 6.6e11 l^-3.33 /cm, bloodless skin .244 + 85.3 exp(-(l - 154) / 66.2) /cm (Jacques 1998, "Skin optics
// summary"), whole blood of 150 g/l, 75 % oxygenated, from the molar extinction of Prahl's tables (1999). Reduced scattering
// 46 (l / 500)^-1.421 /cm (Jacques 2013, "Optical properties of biological tissues: a review"). K = 2 mu_a, S = 3/4 mu_s'
// (Star et al. 1988). The surface's own reflection is the specular lobe's business and not part of it. Nothing is fitted: with
// .025 melanin and .03 blood it gives (.53, .37, .29), with .30 and .02 (.097, .055, .034), where measured skin has about
// (.55, .36, .27) and (.10, .06, .04).

#include "synth/skin/tone.h"

#include "faceprobe/core/color.h"
#include "faceprobe/synth/skin.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faceprobe::synth {
namespace {

constexpr std::size_t kWavelengths = 31;
constexpr double kFirstNm = 400;
constexpr double kStepNm = 10;
constexpr double kEpidermisCm = 0.006;
constexpr double kOxygenation = 0.75;
constexpr double kBloodGramsPerLitre = 150;
constexpr double kHaemoglobinGramsPerMole = 64500;

// Molar extinction, 1/(cm M), 400 to 700 nm (Prahl 1999).
constexpr std::array<double, kWavelengths> kOxygenated = {
    266232,  466840,  480360,  246072, 102580, 62816,   44480, 33209.2, 26629.2, 23684.4, 20932.8,
    20035.2, 24202.4, 39956.8, 53236,  43016,  32613.2, 44496, 50104,   14400.8, 3200,    1506,
    942,     610,     442,     368,    319.6,  294,     277.6, 276,     290};
constexpr std::array<double, kWavelengths> kDeoxygenated = {
    223296,  303956,  407560,  528600, 413280, 103292, 23388.8, 16156.4, 14550,   16684,   20862,
    25773.6, 31589.6, 39036.4, 46592,  53412,  53788,  45072,   37020,   28324.4, 14677.2, 9443.6,
    6509.6,  5148.8,  4345.2,  3750.1, 3226.6, 2795.1, 2407.9,  2052,    1794.3};

// Bell-shaped bands, roughly what a camera's sensor and its matrix to Rec.709 amount to.
struct Band {
  double centre_nm;
  double deviation_nm;
};
constexpr std::array<Band, 3> kBands = {{{610, 30}, {545, 32}, {455, 25}}};

struct Spectrum {
  double melanosome, bloodless, blood, scattering;  // 1/cm
  std::array<double, 3> weight;                     // in the three bands
};

std::array<Spectrum, kWavelengths> make_spectra() {
  std::array<Spectrum, kWavelengths> spectra{};
  std::array<double, 3> total{};
  for (std::size_t i = 0; i < kWavelengths; ++i) {
    const double nm = kFirstNm + kStepNm * static_cast<double>(i);
    const double extinction = kOxygenation * kOxygenated[i] + (1 - kOxygenation) * kDeoxygenated[i];
    spectra[i].melanosome = 6.6e11 * std::pow(nm, -3.33);
    spectra[i].bloodless = 0.244 + 85.3 * std::exp(-(nm - 154) / 66.2);
    spectra[i].blood = std::log(10.0) * extinction * kBloodGramsPerLitre / kHaemoglobinGramsPerMole;
    spectra[i].scattering = 46 * std::pow(nm / 500, -1.421);
    for (std::size_t c = 0; c < 3; ++c) {
      const double z = (nm - kBands[c].centre_nm) / kBands[c].deviation_nm;
      total[c] += spectra[i].weight[c] = std::exp(-0.5 * z * z);
    }
  }
  for (Spectrum& s : spectra) {
    for (std::size_t c = 0; c < 3; ++c) s.weight[c] /= total[c];
  }
  return spectra;
}

double reflectance(const Spectrum& s, double melanin, double haemoglobin) {
  const double scatter = 0.75 * s.scattering;
  const double k_dermis = 2 * (haemoglobin * s.blood + (1 - haemoglobin) * s.bloodless) / scatter;
  const double dermis = 1 + k_dermis - std::sqrt(k_dermis * k_dermis + 2 * k_dermis);
  const double a = 1 + 2 * (melanin * s.melanosome + (1 - melanin) * s.bloodless) / scatter;
  const double b = std::sqrt(a * a - 1);
  const double depth = b * scatter * kEpidermisCm;
  const double below = a * std::sinh(depth) + b * std::cosh(depth);
  const double back = std::sinh(depth) / below;
  const double through = b / below;
  return back + through * through * dermis / (1 - back * dermis);
}

Eigen::Vector3f log_change(float melanin, float haemoglobin, float melanin_factor, float haemoglobin_factor) {
  return (skin_tone(melanin * melanin_factor, haemoglobin * haemoglobin_factor).array().log() -
          skin_tone(melanin, haemoglobin).array().log())
      .matrix();
}

}  // namespace

Eigen::Vector3f skin_tone(float melanin, float haemoglobin) {
  static const std::array<Spectrum, kWavelengths> spectra = make_spectra();
  const double m = std::clamp(static_cast<double>(melanin), 0.0, 1.0);
  const double h = std::clamp(static_cast<double>(haemoglobin), 0.0, 1.0);
  Eigen::Vector3d rgb = Eigen::Vector3d::Zero();
  for (const Spectrum& s : spectra) {
    rgb += reflectance(s, m, h) * Eigen::Vector3d(s.weight[0], s.weight[1], s.weight[2]);
  }
  return rgb.cast<float>();
}

float melanin_of(const Eigen::Vector3f& tone) {
  const float wanted = luminance(tone.data());
  float low = kMinMelanin;
  float high = kMaxMelanin;
  for (int i = 0; i < 20; ++i) {
    const float middle = std::sqrt(low * high);
    (luminance(skin_tone(middle, kTypicalBlood).data()) > wanted ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

const PigmentAxes& pigment_axes() {
  static const PigmentAxes axes = {log_change(0.05F, kTypicalBlood, 1.5F, 1.0F).normalized(),
                                   log_change(0.05F, kTypicalBlood, 1.0F, 1.5F).normalized()};
  return axes;
}

float redness_response(const Eigen::Vector3f& tone) {
  return log_change(melanin_of(tone), kTypicalBlood, 1.0F, 2.0F).norm();
}

}  // namespace faceprobe::synth
