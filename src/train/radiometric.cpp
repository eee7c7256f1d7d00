#include "train/radiometric.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace faceprobe::train {

namespace {

constexpr int kLowestCode = 8;
constexpr int kHighestCode = 247;
constexpr int kSteps = 24;   // of the search, each side of sRGB
constexpr int kStrips = 16;  // the halves of the skin take turns in this many strips, so that both see light and shade

// Of the odds: code^c / (code^c + (1 - code)^c).
double bent(double code, double contrast) {
  const double up = std::pow(code, contrast);
  return up / (up + std::pow(1 - code, contrast));
}

// sRGB's curve in double (core/color.h has it in float, and differences of logs are small).
double srgb_inverse(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }

// Codes as the logarithms of their odds, which a contrast multiplies.
SkinTriples log_odds(const SkinTriples& codes) {
  const auto of = [](const Eigen::MatrixX3d& code) -> Eigen::MatrixX3d {
    return (code.array() / (1 - code.array())).log().matrix();
  };
  return {of(codes.middle), of(codes.before), of(codes.after)};
}

double code_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

// Of srgb_inverse() of a code that has been bent, and its derivative by that code.
double log_light(double bent) {
  return bent <= 0.04045 ? std::log(bent / 12.92) : 2.4 * std::log((bent + 0.055) / 1.055);
}
double log_light_slope(double bent) { return bent <= 0.04045 ? 1 / bent : 2.4 / (bent + 0.055); }

struct Change {
  Eigen::RowVector3d log_light;  // of the middle against its neighbours
  double noise_variance;         // summed over the channels, for one unit in the middle's codes
};

Change change(const SkinTriples& odds, Eigen::Index i, double contrast) {
  Change result{Eigen::RowVector3d::Zero(), 0};
  for (int c = 0; c < 3; ++c) {
    const double middle = code_of(contrast * odds.middle(i, c));
    const double code = code_of(odds.middle(i, c));
    result.log_light(c) = log_light(middle) - 0.5 * (log_light(code_of(contrast * odds.before(i, c))) +
                                                     log_light(code_of(contrast * odds.after(i, c))));
    const double slope = log_light_slope(middle) * contrast * middle * (1 - middle) / (code * (1 - code));
    result.noise_variance += slope * slope;
  }
  return result;
}

using Gram = Eigen::Matrix3d;

// Sums of outer products of the changes, in units of their noise, for the two halves of the skin.
std::array<Gram, 2> grams(const SkinTriples& odds, double contrast) {
  std::array<Gram, 2> sums = {Gram::Zero(), Gram::Zero()};
  const Eigen::Index count = odds.middle.rows();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Change one = change(odds, i, contrast);
    sums[static_cast<std::size_t>(i * kStrips / count % 2)] +=
        one.log_light.transpose() * one.log_light / one.noise_variance;
  }
  return sums;
}

double third_share(const Gram& gram) {
  const Eigen::Vector3d squares = Eigen::SelfAdjointEigenSolver<Gram>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  const Eigen::Vector3d values = squares.cwiseMax(0.0).cwiseSqrt();  // in increasing order
  return values.sum() > 0 ? values(0) / values.sum() : 0.0;
}

struct Best {
  double log_contrast = 0;
  double share = 1;
  bool at_border = false;
};

// The lowest of the curve through samples at equal steps, with a parabola through the three around the lowest sample.
Best lowest(const std::vector<double>& shares, double step) {
  const auto at = std::min_element(shares.begin(), shares.end());
  const auto i = static_cast<std::size_t>(at - shares.begin());
  Best best{(static_cast<double>(i) - kSteps) * step, *at, i == 0 || i + 1 == shares.size()};
  if (best.at_border) return best;
  const double bend = shares[i - 1] - 2 * shares[i] + shares[i + 1];
  if (bend > 0) best.log_contrast += 0.5 * step * (shares[i - 1] - shares[i + 1]) / bend;
  return best;
}

// Mean of 3 x 3 pixels as codes in [0, 1]; false when one of them is not usable.
bool mean_code(const ByteImage& encoded, const ByteImage& skin, int x, int y, Eigen::RowVector3d* mean) {
  mean->setZero();
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (skin(i, j) == 0) return false;
      for (int c = 0; c < 3; ++c) {
        const int code = encoded(i, j, c);
        if (code < kLowestCode || code > kHighestCode) return false;
        (*mean)(c) += code / (9.0 * 255.0);
      }
    }
  }
  return true;
}

bool shows_pigment(const SkinTriples& one, const TripleOptions& options) {
  const Eigen::RowVector3d codes = one.middle.row(0) - 0.5 * (one.before.row(0) + one.after.row(0));
  if (codes.cwiseAbs().maxCoeff() < static_cast<double>(options.min_change)) return false;
  const double step =
      std::max((one.middle - one.before).cwiseAbs().maxCoeff(), (one.middle - one.after).cwiseAbs().maxCoeff());
  if (step > static_cast<double>(options.max_change)) return false;
  const Eigen::RowVector3d logs = change(log_odds(one), 0, 1).log_light;
  return (logs.array() - logs.mean()).matrix().norm() >= static_cast<double>(options.min_colour_share) * logs.norm();
}

void check(const SkinTriples& triples) {
  for (const Eigen::MatrixX3d* codes : {&triples.middle, &triples.before, &triples.after}) {
    if (codes->rows() != triples.middle.rows()) throw std::invalid_argument("Skin triples need three places each.");
    if (!((codes->array() > 0) && (codes->array() < 1)).all()) {
      throw std::invalid_argument("Skin triples need codes between 0 and 1.");
    }
  }
}

}  // namespace

std::string TripleOptions::validate() const {
  if (spacing_px < 1 || spacing_px > 100) return "spacing_px must be from 1 to 100.";
  if (!(min_change >= 0) || !(max_change > min_change)) return "min_change must lie between 0 and max_change.";
  if (!(min_colour_share >= 0) || !(min_colour_share < 1)) return "min_colour_share must lie in [0, 1).";
  return {};
}

std::string ResponseOptions::validate() const {
  if (!(max_contrast >= 1.05) || !(max_contrast <= 4)) return "max_contrast must be from 1.05 to 4.";
  if (min_triples < 3) return "min_triples must be 3 or more.";
  if (!(min_gain >= 0) || !(min_gain < 1)) return "min_gain must lie in [0, 1).";
  if (!(max_residual > 0)) return "max_residual must be positive.";
  if (!(max_disagreement > 0)) return "max_disagreement must be positive.";
  return {};
}

double linear_from_code(double code, double contrast) {
  return srgb_inverse(bent(std::clamp(code, 0.0, 1.0), contrast));
}

Image linearise(const ByteImage& encoded, double contrast) {
  if (!(contrast > 0) || !std::isfinite(contrast)) throw std::invalid_argument("contrast must be positive.");
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(linear_from_code(static_cast<double>(i) / 255, contrast));
  }
  Image linear(encoded.width(), encoded.height(), encoded.channels());
  std::transform(encoded.values().begin(), encoded.values().end(), linear.data(),
                 [&](std::uint8_t code) { return table[code]; });
  return linear;
}

SkinTriples skin_triples(const ByteImage& encoded, const ByteImage& skin, const TripleOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  if (encoded.channels() != 3 || skin.channels() != 1 || !skin.same_size(encoded)) {
    throw std::invalid_argument("Skin triples need a colour picture and a mask of its size.");
  }
  std::vector<SkinTriples> found;
  const int d = options.spacing_px;
  const std::array<std::array<int, 2>, 2> directions = {{{d, 0}, {0, d}}};
  SkinTriples one{Eigen::MatrixX3d(1, 3), Eigen::MatrixX3d(1, 3), Eigen::MatrixX3d(1, 3)};
  // Every other pixel: means of 3 x 3 hardly differ from one to the next.
  for (int y = 1; y < encoded.height() - 1; y += 2) {
    for (int x = 1; x < encoded.width() - 1; x += 2) {
      for (const auto& [dx, dy] : directions) {
        if (x - dx < 1 || y - dy < 1 || x + dx > encoded.width() - 2 || y + dy > encoded.height() - 2) continue;
        Eigen::RowVector3d middle;
        Eigen::RowVector3d before;
        Eigen::RowVector3d after;
        if (!mean_code(encoded, skin, x, y, &middle) || !mean_code(encoded, skin, x - dx, y - dy, &before) ||
            !mean_code(encoded, skin, x + dx, y + dy, &after)) {
          continue;
        }
        one.middle = middle;
        one.before = before;
        one.after = after;
        if (shows_pigment(one, options)) found.push_back(one);
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(found.size());
  SkinTriples triples{Eigen::MatrixX3d(count, 3), Eigen::MatrixX3d(count, 3), Eigen::MatrixX3d(count, 3)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const SkinTriples& triple = found[static_cast<std::size_t>(i)];
    triples.middle.row(i) = triple.middle.row(0);
    triples.before.row(i) = triple.before.row(0);
    triples.after.row(i) = triple.after.row(0);
  }
  return triples;
}

ResponseFit fit_response(const SkinTriples& triples, const ResponseOptions& options) {
  if (const std::string fault = options.validate(); !fault.empty()) throw std::invalid_argument(fault);
  check(triples);
  ResponseFit fit;
  fit.triples = triples.middle.rows();
  if (fit.triples < options.min_triples) {
    fit.reason = "sRGB is kept: only " + std::to_string(fit.triples) + " places on the skin show pigment.";
    return fit;
  }
  const SkinTriples odds = log_odds(triples);
  const double step = std::log(options.max_contrast) / kSteps;
  std::vector<double> shares;
  std::array<std::vector<double>, 2> half_shares;
  for (int i = -kSteps; i <= kSteps; ++i) {
    const std::array<Gram, 2> halves = grams(odds, std::exp(i * step));
    shares.push_back(third_share(halves[0] + halves[1]));
    for (std::size_t h = 0; h < 2; ++h) half_shares[h].push_back(third_share(halves[h]));
  }
  const Best best = lowest(shares, step);
  fit.fitted = std::exp(best.log_contrast);
  fit.residual_srgb = shares[kSteps];
  const std::array<Gram, 2> at_best = grams(odds, fit.fitted);
  fit.residual = third_share(at_best[0] + at_best[1]);
  if (fit.residual > best.share) {  // the parabola was no good; the sample is
    fit.fitted = std::exp(step * std::round(best.log_contrast / step));
    fit.residual = best.share;
  }
  fit.disagreement = std::abs(lowest(half_shares[0], step).log_contrast - lowest(half_shares[1], step).log_contrast);
  if (best.at_border) {
    fit.reason = "sRGB is kept: the best curve lies beyond those that were tried.";
  } else if (fit.residual > options.max_residual) {
    fit.reason =
        "sRGB is kept: the skin's colours do not lie in a plane under any curve; noise or relief outweighs pigment.";
  } else if (fit.residual > (1 - options.min_gain) * fit.residual_srgb) {
    fit.reason = "sRGB is kept: no other curve explains the skin clearly better.";
  } else if (fit.disagreement > options.max_disagreement) {
    fit.reason = "sRGB is kept: two halves of the skin ask for different curves.";
  } else {
    fit.kept_srgb = false;
    fit.contrast = fit.fitted;
  }
  return fit;
}

}  // namespace faceprobe::train
