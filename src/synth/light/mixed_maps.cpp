#include "faceprobe/synth/mixed_maps.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"
#include "faceprobe/core/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace faceprobe::synth {
namespace {

constexpr int kMostMaps = 10000;

std::string out_of_range(const char* what, double value, double high) {
  return std::string("Of mixed maps, ") + what + " is " + std::to_string(value) + "; allowed is 0 to " +
         std::to_string(high) + ".";
}

double mean_luminance(const EnvMap& map) { return map.integral().dot(kLuminanceWeights.cast<double>()) / (4 * kPi); }

void scale(EnvMap& map, double factor) {
  for (float& value : map.radiance().values()) value *= static_cast<float>(factor);
}

// Luminance to a power, colours as they are, mean luminance 1.
EnvMap with_contrast(EnvMap map, double exponent) {
  const double before = mean_luminance(map);
  Image& radiance = map.radiance();
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      Eigen::Map<Eigen::Vector3f> pixel(radiance.pixel(x, y));
      const double relative = static_cast<double>(pixel.dot(kLuminanceWeights)) / before;
      if (relative > 0) pixel *= static_cast<float>(std::pow(relative, exponent - 1));
    }
  }
  scale(map, 1 / mean_luminance(map));
  return map;
}

// Whole columns to the right, then seen in a mirror: both keep every texel's solid angle.
EnvMap turned(const EnvMap& map, int columns, bool mirrored) {
  EnvMap out(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const int to = (x + columns) % map.width();
      std::copy_n(map.radiance().pixel(x, y), 3, out.radiance().pixel(mirrored ? map.width() - 1 - to : to, y));
    }
  }
  return out;
}

struct AddedLamp {
  Eigen::Vector3f direction;
  double radius;           // radians
  Eigen::Vector3f colour;  // of luminance 1
  double energy;           // mean luminance that it adds to the map
};

AddedLamp draw_added_lamp(Random& random) {
  AddedLamp lamp;
  lamp.direction = random.direction();
  lamp.radius = random.log_between(0.02, 0.25);
  // From candle to blue sky, warm ones a little more often.
  const double warmth = random.normal(0.06, 0.2);
  lamp.colour = Eigen::Vector3d(std::exp(warmth), 1, std::exp(-warmth)).cast<float>();
  lamp.colour /= lamp.colour.dot(kLuminanceWeights);
  lamp.energy = random.log_between(0.1, 2.0);
  return lamp;
}

// A disc whose edge is a texel wide.
void add_lamp(const AddedLamp& lamp, EnvMap& map) {
  const double texel = kPi / map.height();
  const double radius = std::max(lamp.radius, texel);
  EnvMap disc(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      const double angle =
          std::acos(std::clamp(static_cast<double>(map.direction(x, y).dot(lamp.direction)), -1.0, 1.0));
      const double inside = std::clamp((radius - angle) / texel + 0.5, 0.0, 1.0);
      Eigen::Map<Eigen::Vector3f>(disc.radiance().pixel(x, y)) = static_cast<float>(inside) * lamp.colour;
    }
  }
  const double found = mean_luminance(disc);
  if (!(found > 0)) return;
  const auto factor = static_cast<float>(lamp.energy / found);
  for (std::size_t i = 0; i < map.radiance().values().size(); ++i)
    map.radiance().data()[i] += factor * disc.radiance().data()[i];
}

NamedMap mix(std::span<const NamedMap> maps, const MixOptions& options, Random random) {
  const auto draw_map = [&]() -> const NamedMap& {
    return maps[static_cast<std::size_t>(random.below(static_cast<int>(maps.size())))];
  };
  const auto draw_exponent = [&] { return std::clamp(std::exp(random.normal(0, options.contrast)), 0.6, 1.5); };
  const NamedMap& first = draw_map();
  const NamedMap& second = draw_map();
  const double share = options.second * std::pow(random.uniform(), 1.5);
  EnvMap out = with_contrast(first.second, draw_exponent());
  EnvMap other = second.second;
  if (other.height() != out.height()) other = resize(other, out.width(), out.height());
  other = with_contrast(std::move(other), draw_exponent());
  const int columns = random.below(out.width());
  other = turned(other, columns, random.chance(0.5));
  for (std::size_t i = 0; i < out.radiance().values().size(); ++i) {
    float& value = out.radiance().data()[i];
    value = static_cast<float>((1 - share) * static_cast<double>(value) +
                               share * static_cast<double>(other.radiance().data()[i]));
  }
  const double chance = random.uniform();
  const int lamps = chance < 0.5 * options.lamps ? 2 : chance < options.lamps ? 1 : 0;
  for (int i = 0; i < lamps; ++i) add_lamp(draw_added_lamp(random), out);
  scale(out, 1 / mean_luminance(out));
  return {first.first + "+" + second.first, std::move(out)};
}

}  // namespace

std::string MixOptions::validate() const {
  if (count < 0 || count > kMostMaps) return out_of_range("the count", count, kMostMaps);
  if (!(second >= 0 && second <= 1)) return out_of_range("the second map's share", second, 1);
  if (!(contrast >= 0 && contrast <= 1)) return out_of_range("the deviation of contrast", contrast, 1);
  if (!(lamps >= 0 && lamps <= 1)) return out_of_range("the probability of a lamp", lamps, 1);
  return {};
}

std::vector<NamedMap> mixed_maps(std::span<const NamedMap> maps, const MixOptions& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw std::invalid_argument(problem);
  std::vector<NamedMap> mixed;
  if (maps.empty() || options.count == 0) return mixed;
  for (const auto& [name, map] : maps) {
    if (!(mean_luminance(map) > 0))
      throw Error(ExitCode::kInput,
                  "The environment map " + name + " holds no light that could be mixed. Leave it out.");
  }
  mixed.reserve(static_cast<std::size_t>(options.count));
  for (int i = 0; i < options.count; ++i) {
    mixed.push_back(mix(maps, options, Random({options.seed, 0x313C, static_cast<std::uint64_t>(i)})));
    // Two mixtures of the same maps are two maps.
    mixed.back().first += "#" + std::to_string(i);
  }
  return mixed;
}

}  // namespace faceprobe::synth
