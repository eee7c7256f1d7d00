// R. T. Tan, K. Ikeuchi: Separating reflection components of textured surfaces using a single image. IEEE PAMI 27(2),
// 2005.
//
// The paper keeps two pictures, the input and a specular-free one, and takes highlight away from single pixels until
// the log-differentials of both agree. All of it is a function of one number per pixel, g = 3 c - 1, where c is the
// maximum chromaticity (largest channel / sum). Taking white light away until g becomes g' (the paper's
// specular-to-diffuse mechanism) leaves the sum total g / g', and the specular-free picture, made with the arbitrary
// constant Lambda, has the sum total g / (3 Lambda - 1). The difference of the log-differentials between neighbours p
// and q is therefore
//   |log(total_p' / total_q') - log(free_p / free_q)| = |log g_q' - log g_p'|
// Lambda cancels, neither logarithms nor a second picture are needed, and the iteration only ever raises the lower g of
// two.

#include "faceprobe/core/parallel.h"
#include "highlight/scene.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace faceprobe::highlight {
namespace {

constexpr float kCameraDark = 20.0F / 255.0F;  // darker than this in all channels: too noisy for a chromaticity
constexpr float kLambda = 0.6F;                // maximum chromaticity of the specular-free colours
constexpr float kColourJump = 0.1F;            // thR = thG: a larger step in both is another surface colour
constexpr float kNoiseChroma = 0.01F;          // a smaller step of the maximum chromaticity is noise
constexpr int kSteps = 50;                     // epsilon = .5, .49, ... 0
constexpr float kEpsilonStep = 0.01F;
constexpr int kMaxSweeps = 50;  // at one epsilon; a bound for odd pictures, photos need up to about fifteen

enum Link : std::uint8_t { kRight = 1, kBelow = 2 };

struct Site {
  float g = 0;      // saturation() now; 0 = takes no part (outside, dark or grey)
  float limit = 0;  // g at which the smallest channel is used up
};

struct Grid {
  std::vector<Site> sites;
  std::vector<std::uint8_t> links;  // neighbours of one surface colour
  std::size_t at(const Scene& scene, int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width()) + static_cast<std::size_t>(x);
  }
};

Site make_site(const Scene& scene, int x, int y) {
  if (!scene.inside(x, y)) return {};
  const Extremes e = scene.extremes(x, y);
  if (e.high < kCameraDark || is_grey(e)) return {};
  return {saturation(e), 3 * (e.high - e.low) / (e.total - 3 * e.low) - 1};
}

// Red and green chromaticity of the specular-free colour, which highlights do not move.
std::array<float, 2> free_chromaticity(const Scene& scene, int x, int y) {
  const std::array<float, 3> rgb = scene.colour(x, y);
  const Extremes e = scene.extremes(x, y);
  const float total = (3 * e.high - e.total) / (3 * kLambda - 1);
  const float taken = (e.total - total) / 3;
  return {(rgb[0] - taken) / total, (rgb[1] - taken) / total};
}

bool same_colour(const std::array<float, 2>& a, const std::array<float, 2>& b) {
  return std::abs(a[0] - b[0]) <= kColourJump || std::abs(a[1] - b[1]) <= kColourJump;
}

Grid make_grid(const Scene& scene) {
  Grid grid{std::vector<Site>(scene.linear.pixel_count()), std::vector<std::uint8_t>(scene.linear.pixel_count())};
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < scene.width(); ++x) grid.sites[grid.at(scene, x, y)] = make_site(scene, x, y);
    }
  });
  const auto usable = [&](int x, int y) { return grid.sites[grid.at(scene, x, y)].g > 0; };
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < scene.width(); ++x) {
        if (!usable(x, y)) continue;
        const std::array<float, 2> here = free_chromaticity(scene, x, y);
        const auto linked = [&](int nx, int ny) {
          return nx < scene.width() && ny < scene.height() && usable(nx, ny) &&
                 same_colour(here, free_chromaticity(scene, nx, ny));
        };
        grid.links[grid.at(scene, x, y)] =
            static_cast<std::uint8_t>((linked(x + 1, y) ? kRight : 0) | (linked(x, y + 1) ? kBelow : 0));
      }
    }
  });
  return grid;
}

struct Sweep {
  std::int64_t specular = 0;  // pairs that fail the test
  std::int64_t raised = 0;
};

// Two neighbours: when their g differ by more than the factor exp(epsilon), the lower one holds more highlight and
// takes over the maximum chromaticity of the other, unless that would use up its smallest channel.
bool settle(Site* a, Site* b, float factor, Sweep* sweep) {
  Site* lower = a->g < b->g ? a : b;
  const float target = std::max(a->g, b->g);
  if (target <= lower->g * factor || target - lower->g < 3 * kNoiseChroma) return false;
  ++sweep->specular;
  if (target >= lower->limit) return false;
  lower->g = target;
  ++sweep->raised;
  return true;
}

// In place, in scan order: a change is seen by the pairs that follow. A pixel that settles with its right neighbour is
// done for this sweep.
Sweep sweep_once(const Scene& scene, float factor, Grid* grid) {
  Sweep sweep;
  const auto width = static_cast<std::size_t>(scene.width());
  for (std::size_t i = 0; i < grid->sites.size(); ++i) {
    const std::uint8_t links = grid->links[i];
    Site* site = &grid->sites[i];
    if ((links & kRight) != 0 && settle(site, site + 1, factor, &sweep)) continue;
    if ((links & kBelow) != 0) settle(site, site + width, factor, &sweep);
  }
  return sweep;
}

}  // namespace

Image tan_highlight(const Scene& scene) {
  Grid grid = make_grid(scene);
  for (int step = 0; step <= kSteps; ++step) {
    const float factor = std::exp(static_cast<float>(kSteps - step) * kEpsilonStep);
    // Further sweeps at the same epsilon only while they leave fewer specular pairs. Going on until no pixel can be
    // raised takes ten times the sweeps and removes colour with the highlight: 3 dB less on Shen's picture "animals",
    // .4 dB more on "fruit".
    std::int64_t before = std::numeric_limits<std::int64_t>::max();
    for (int i = 0; i < kMaxSweeps; ++i) {
      const Sweep sweep = sweep_once(scene, factor, &grid);
      if (sweep.raised == 0 || sweep.specular >= before) break;
      before = sweep.specular;
    }
  }

  Image amount(scene.width(), scene.height(), 1);
  parallel_for(scene.height(), scene.threads, [&](int first, int last) {
    for (int y = first; y < last; ++y) {
      for (int x = 0; x < scene.width(); ++x) {
        const Site& site = grid.sites[grid.at(scene, x, y)];
        if (site.g > 0) amount(x, y) = white_part(scene.extremes(x, y), site.g);
      }
    }
  });
  return amount;
}

}  // namespace faceprobe::highlight
