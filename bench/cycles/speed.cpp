// The time of either renderer at equal error: Cycles renders each map with more and more samples, and the time at which its error
// passes ours lies between two of them.

#include "cycles/compare.h"
#include "cycles/report.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/microfacet.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

namespace faceprobe::bench {

namespace {

constexpr std::array<int, 7> kLadder = {4, 8, 16, 32, 64, 128, 256};  // Cycles' samples
constexpr float kLightThreshold = 0.01F;                              // Cycles' default
constexpr int kTurns = 8;                                             // of each map, to fill a view's images

struct OurTime {
  double per_image = 0;
  double per_view = 0;
  int images = 0;
};

// From mesh and prepared maps to pictures of both layers; the view's transport is shared by its images.
OurTime time_ours(const Comparison& comparison, const ComparisonOptions& options) {
  std::vector<TurnedMap> turned;
  for (int i = 0; i < options.images_per_view; ++i) {
    const auto maps = static_cast<int>(comparison.maps.size());
    const float turn = static_cast<float>(i / maps % kTurns) / static_cast<float>(kTurns);
    turned.push_back({&comparison.maps[static_cast<std::size_t>(i % maps)].light, static_cast<float>(2 * kPi) * turn});
  }
  const auto start = std::chrono::steady_clock::now();
  const FastView view(comparison.head, comparison.camera, kLobeRoughness, kSkinF0, transport_options(options));
  const auto images = static_cast<int>(view.render(turned).size());
  const double all = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return {all / images, view.seconds(), images};
}

// Cycles' seconds at our error, by interpolation between the two renders on either side (both logarithmic).
struct EqualError {
  double samples = 0;
  double seconds = 0;
  bool more = false;  // Cycles needs more than the longest render
};

EqualError equal_error(double ours, const std::vector<double>& errors, const std::vector<double>& seconds) {
  std::size_t i = 0;
  while (i < errors.size() && errors[i] > ours) ++i;
  if (i == errors.size()) return {kLadder.back(), seconds.back(), true};
  if (i == 0) return {kLadder.front(), seconds.front(), false};
  const double t = std::log(errors[i - 1] / ours) / std::log(errors[i - 1] / errors[i]);
  const auto between = [t](double a, double b) { return a * std::pow(b / a, t); };
  return {between(kLadder[i - 1], kLadder[i]), between(seconds[i - 1], seconds[i]), false};
}

}  // namespace

void compare_speed(const Comparison& comparison, const ComparisonOptions& options) {
  const OurTime ours = time_ours(comparison, options);
  std::vector<CyclesRender> renders;
  for (const MapComparison& map : comparison.maps) {
    for (const int samples : kLadder) renders.push_back({map.file, samples, 3, kLightThreshold});
  }
  const std::vector<CyclesPicture> pictures = render_with_cycles(comparison.cycles, renders);

  std::printf(
      "\nTime at equal error, all threads, start-up and files excluded. Ours: %.1f ms per image with both layers (%d "
      "images\n"
      "in a view, whose transport takes %.2f s). Cycles: between renders of 4, 8, ... %d samples; \"+\" where it needs "
      "more.\n\n"
      "| map | layer | our error | Cycles' samples | its time, ms | times ours |\n"
      "|---|---|---:|---:|---:|---:|\n",
      1000 * ours.per_image, ours.images, ours.per_view, kLadder.back());
  double log_sum = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < comparison.maps.size(); ++m) {
    const MapComparison& map = comparison.maps[m];
    for (const bool diffuse : {true, false}) {
      std::vector<double> errors;
      std::vector<double> seconds;
      for (std::size_t i = 0; i < kLadder.size(); ++i) {
        const CyclesPicture& picture = pictures[m * kLadder.size() + i];
        errors.push_back(relative_rmse(diffuse ? picture.diffuse : picture.glossy,
                                       diffuse ? map.cycles_diffuse : map.cycles_glossy, comparison.face));
        seconds.push_back(picture.seconds);
      }
      const double our_error = diffuse ? map.diffuse.ours : map.glossy.ours;
      const EqualError equal = equal_error(our_error, errors, seconds);
      const double ratio = equal.seconds / ours.per_image;
      log_sum += std::log(ratio);
      least = std::min(least, ratio);
      std::printf("| %s | %s | %.2f | %.0f%s | %.0f | %.0f%s |\n", map.map.name.c_str(),
                  diffuse ? "diffuse" : "specular", 100 * our_error, equal.samples, equal.more ? "+" : "",
                  1000 * equal.seconds, ratio, equal.more ? "+" : "");
    }
  }
  std::printf("\nGeometric mean %.0f x, least %.0f x (target 50)\n",
              std::exp(log_sum / static_cast<double>(2 * comparison.maps.size())), least);
}

}  // namespace faceprobe::bench
