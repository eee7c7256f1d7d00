// R. T. Tan, K. Ikeuchi: Separating reflection components of textured surfaces using a single image. IEEE PAMI 27(2), 2005.
//
// The paper works on two pictures, the input and a specular-free one, and lowers the highlight of single pixels until the
// log-differentials of both agree. All of that is a function of one number per pixel. Let c be the maximum chromaticity (largest
// channel / sum) and g = 3 c - 1. Moving a pixel to maximum chromaticity c' by taking white light away leaves the sum
//   total' = total g / g'                                       (eq. 11 with m_d, the diffuse part)
// so the specular-free picture, made with the arbitrary constant Lambda, has total g0 / (3 Lambda - 1), and the difference of the
// log-differentials of neighbours p, q (section 4.2) is
//   |log(total_p' / total_q') - log(free_p / free_q)| = |log g_q' - log g_p'|:
// Lambda cancels, no logarithm and no second picture is needed, and the iteration only ever raises g of the lower of two.

#include "highlight/scene.h"

#include <cmath>

namespace faceprobe::highlight {
namespace {

constexpr float kCameraDark = 20.0F / 255.0F;  // darker in all channels: too noisy for a chromaticity
constexpr float kChromaJump = 0.1F;            // thR = thG: more than this in both is another surface colour
constexpr float kNoiseChroma = 0.01F;          // less difference of maximum chromaticity than this is noise
constexpr int kEpsilonSteps = 50;              // .5, .49, ... 0
constexpr float kEpsilonStep = 0.01F;

struct Site {
  float total = 0;
  float low = 0;
  float red = 0;    // chromaticities of the specular-free colour: a highlight does not move them
  float green = 0;
  float start = 0;  // g of the picture
  float g = 0;      // g now
  float limit = 0;  // g at which the smallest channel is used up
  bool usable = false;
};

Site make_site(const Scene& scene, int x, int y) {
  Site site;
  if (!scene.inside(x, y)) return site;
  const std::array<float, 3> rgb = scene.colour(x, y);
  const Extremes e = scene.extremes(x, y);
  if (e.high < kCameraDark || is_grey(e)) return site;
  const float chroma = e.total - 3 * e.low;
  site.total = e.total;
  site.low = e.low;
  site.red = rgb[0] / e.total;
  site.green = rgb[1] / e.total;
  site.start = site.g = 3 * e.high / e.total - 1;
  site.limit = 3 * (e.high - e.low) / chroma - 1;
  site.usable = true;
  return site;
}

}  // namespace
}  // namespace faceprobe::highlight
