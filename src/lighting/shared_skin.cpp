#include "faceprobe/lighting/shared_skin.h"

#include "faceprobe/core/color.h"
#include "faceprobe/lighting/albedo.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace faceprobe::lighting {

namespace {

// ESTIMATES. The level of an albedo is a guess of each photo's; regions differ by lamps that a split takes for skin.
constexpr double kLevelDeviation = 0.3;   // of log luminance
constexpr double kRegionDeviation = 0.1;  // of log of a region's albedo over the face's
constexpr double kGainDeviation = 0.3;    // of log of the highlights' gain
constexpr double kHuber = 2;              // standard deviations beyond which a photo counts less
constexpr int kReweightings = 100;        // ten do for what is not far off

struct RobustMean {
  Eigen::VectorXd mean;
  double variance = 0;        // of each component
  std::vector<double> trust;  // of each value, 0..1
};

struct MeanPrior {
  Eigen::VectorXd mean;
  double deviation = 1;
};

// Huber's estimate of the mean of vectors of independent normal components, of one deviation a vector; the length of a residual counts. With a
// prior that is not doubted. Its variance is the stated one, or that of the scatter if larger.
RobustMean robust_mean(const std::vector<Eigen::VectorXd>& values, const std::vector<double>& deviations,
                       const std::optional<MeanPrior>& prior = {}) {
  RobustMean out;
  out.trust.assign(values.size(), 1);
  const Eigen::Index size = values.front().size();
  double weight = 0;
  double square = 0;  // of the residuals, weighted
  for (int round = 0; round < kReweightings; ++round) {
    weight = prior ? 1 / (prior->deviation * prior->deviation) : 0;
    Eigen::VectorXd sum = prior ? Eigen::VectorXd(weight * prior->mean) : Eigen::VectorXd::Zero(size);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double own = out.trust[i] / (deviations[i] * deviations[i]);
      sum += own * values[i];
      weight += own;
    }
    const Eigen::VectorXd mean = sum / weight;
    const bool still = round > 0 && (mean - out.mean).norm() < 1e-12;
    out.mean = mean;
    square = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double away = (values[i] - mean).norm() / deviations[i];
      out.trust[i] = std::min(1.0, kHuber / std::max(kHuber, away));
      square += out.trust[i] * away * away;
    }
    if (still) break;
  }
  const double freedom = static_cast<double>(size) * (static_cast<double>(values.size()) - 1);
  out.variance = (freedom > 0 ? std::max(1.0, square / freedom) : 1.0) / weight;
  return out;
}

Eigen::Vector3d log_of(const Eigen::Vector3f& colour) { return colour.cast<double>().array().log(); }

Eigen::VectorXd level_of(const Eigen::Vector3f& colour) {
  const Eigen::Vector3d wide = colour.cast<double>();
  return Eigen::VectorXd::Constant(1, std::log(luminance(wide.data())));
}

Eigen::VectorXd chroma_of(const Eigen::Vector3f& colour) {
  const Eigen::Vector3d log = log_of(colour);
  return Eigen::Vector2d(log[0] - log[1], log[2] - log[1]);
}

Eigen::Vector3d colour_of(double level, const Eigen::VectorXd& chroma) {
  const Eigen::Vector3d colour(std::exp(chroma[0]), 1, std::exp(chroma[1]));
  return colour * (std::exp(level) / luminance(colour.data()));
}

bool usable(const Eigen::Vector3f& colour) { return colour.allFinite() && colour.minCoeff() > 0; }

void check(const std::vector<SkinReading>& readings) {
  if (readings.empty()) throw std::invalid_argument("A shared skin needs a reading.");
  for (const SkinReading& reading : readings) {
    bool good = usable(reading.albedo);
    for (const auto& region : reading.region_albedo) good = good && (!region || usable(*region));
    if (!good) throw std::invalid_argument("Albedos must be above 0 and finite.");
    if (reading.log_deviation && !(*reading.log_deviation > 0 && std::isfinite(*reading.log_deviation)))
      throw std::invalid_argument("Deviations of albedos must be above 0 and finite.");
  }
}

// What the photo itself says of the skin's chromaticity: without the prior, which comes in once for all. Nothing where it says no more than that.
struct Likelihood {
  Eigen::VectorXd mean;
  double deviation = 1;
};
std::optional<Likelihood> likelihood_of(const SkinReading& reading) {
  const double stated = reading.log_deviation.value_or(kUnstatedDeviation);
  const Eigen::VectorXd chroma = chroma_of(reading.albedo);
  if (!reading.has_prior) return Likelihood{chroma, stated};
  const SkinColourPrior prior = skin_colour_prior();
  const double usual = 1 / (prior.deviation * prior.deviation);
  const double all = 1 / (stated * stated);
  if (!(all - usual > 1e-6 * usual)) return std::nullopt;
  return Likelihood{(all * chroma - usual * prior.log_ratio.matrix()) / (all - usual), 1 / std::sqrt(all - usual)};
}

// The regions beside the face: their mean over photos, gains as those of the whole times what the photo's own are off.
void share_regions(const std::vector<SkinReading>& readings, SharedSkin& skin) {
  const bool all_grey = std::ranges::all_of(readings, [](const SkinReading& r) { return r.grey; });
  for (std::size_t r = 0; r < kSkinRegionCount; ++r) {
    std::vector<Eigen::VectorXd> beside;
    std::vector<std::size_t> who;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const SkinReading& reading = readings[i];
      if (!reading.region_albedo[r] || (reading.grey && !all_grey)) continue;
      beside.emplace_back(log_of(*reading.region_albedo[r]) - log_of(reading.albedo));
      who.push_back(i);
    }
    if (beside.size() < 2) continue;
    const RobustMean mean = robust_mean(beside, std::vector<double>(beside.size(), kRegionDeviation));
    for (std::size_t k = 0; k < who.size(); ++k) {
      const Eigen::Vector3d own = (beside[k] - mean.mean).array().exp();
      SharedSkin::Photo& photo = skin.photos[who[k]];
      photo.region_gain[r] = photo.gain.cwiseProduct(own.cast<float>());
    }
  }
}

}  // namespace

SharedSkin share_skin(const std::vector<SkinReading>& readings) {
  check(readings);
  std::vector<Eigen::VectorXd> levels;
  std::vector<Eigen::VectorXd> chromas;
  std::vector<double> deviations;
  std::vector<std::size_t> coloured;
  std::optional<MeanPrior> prior;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    levels.push_back(level_of(readings[i].albedo));
    if (readings[i].grey) continue;
    if (readings[i].has_prior) prior = MeanPrior{skin_colour_prior().log_ratio.matrix(), skin_colour_prior().deviation};
    const std::optional<Likelihood> own = likelihood_of(readings[i]);
    if (!own) continue;
    chromas.push_back(own->mean);
    deviations.push_back(own->deviation);
    coloured.push_back(i);
  }
  const RobustMean level = robust_mean(levels, std::vector<double>(levels.size(), kLevelDeviation));
  SharedSkin skin;
  skin.photos.resize(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) skin.photos[i].trust = level.trust[i];
  Eigen::VectorXd chroma = prior ? prior->mean : chroma_of(readings.front().albedo);
  skin.log_deviation = prior ? prior->deviation : 0;
  if (!chromas.empty()) {
    const RobustMean mean = robust_mean(chromas, deviations, prior);
    chroma = mean.mean;
    skin.log_deviation = std::sqrt(mean.variance);
    for (std::size_t k = 0; k < coloured.size(); ++k) skin.photos[coloured[k]].trust = mean.trust[k];
  }
  const Eigen::Vector3d shared = colour_of(level.mean[0], chroma);
  skin.albedo = shared.cast<float>();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    SharedSkin::Photo& photo = skin.photos[i];
    if (readings[i].grey) {
      photo.gain.setConstant(static_cast<float>(std::exp(levels[i][0] - level.mean[0])));
    } else {
      photo.gain = readings[i].albedo.cast<double>().cwiseQuotient(shared).cast<float>();
    }
    photo.region_gain.fill(photo.gain);
  }
  share_regions(readings, skin);
  return skin;
}

double shared_gain(const std::vector<double>& gains) {
  if (gains.empty()) return 1;
  std::vector<Eigen::VectorXd> logs;
  for (const double gain : gains) {
    if (!(gain > 0 && std::isfinite(gain))) throw std::invalid_argument("Gains must be above 0 and finite.");
    logs.emplace_back(Eigen::VectorXd::Constant(1, std::log(gain)));
  }
  return std::exp(robust_mean(logs, std::vector<double>(logs.size(), kGainDeviation)).mean[0]);
}

}  // namespace faceprobe::lighting
