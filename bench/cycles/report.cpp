#include "cycles/report.h"

#include "cycles/run_blender.h"

#include "cycles/compare.h"
#include "faceprobe/core/color.h"
#include "faceprobe/io/picture_file.h"

#include <algorithm>
#include <cstdio>

namespace faceprobe::bench {

namespace {

// Targets of the comparison, relative RMSE.
constexpr double kDiffuseTarget = 0.02;
constexpr double kSpecularTarget = 0.04;

// The red light's centre of gravity less that of the pixels, along x.
double side_px(const Image& image, const std::vector<int>& pixels) {
  double light = 0;
  double moment = 0;
  double centre = 0;
  for (const int pixel : pixels) {
    const int x = pixel % image.width();
    const auto red = static_cast<double>(image(x, pixel / image.width(), 0));
    light += red;
    moment += red * x;
    centre += x;
  }
  return moment / light - centre / static_cast<double>(pixels.size());
}

void paste(const ByteImage& picture, int column, int row, ByteImage& sheet) {
  for (int y = 0; y < picture.height(); ++y) {
    std::ranges::copy(picture.row(y), sheet.pixel(column * picture.width(), row * picture.height() + y));
  }
}

void draw_map(const MapComparison& map, const std::vector<int>& face, const std::filesystem::path& path) {
  const int size = map.cycles_diffuse.width();
  ByteImage sheet(3 * size, 2 * size, 3);
  const auto draw_row = [&](const Image& ours, const Image& theirs, int row) {
    const float gain = exposure_for_quantile(theirs, 0.95F, 0.8F);
    paste(encode_srgb(ours, gain), 0, row, sheet);
    paste(encode_srgb(theirs, gain), 1, row, sheet);
    paste(difference_picture(ours, theirs, face, 0.25), 2, row, sheet);
  };
  draw_row(map.skin.diffuse, map.cycles_diffuse, 0);
  draw_row(map.metal.glossy, map.cycles_glossy, 1);
  io::write_picture(path, sheet);
}

}  // namespace

void print_errors(const Comparison& comparison, const ComparisonOptions& options) {
  std::printf(
      "Blender %s, %d samples, %d px, %zu pixels of the face. Relative RMSE in %%: ours against Cycles, and Cycles' "
      "own\n"
      "noise. Specular with F = 1: the same Beckmann lobe but for the shadowing term (V-cavities here, Smith there). "
      "Specular\n"
      "of skin: with Fresnel's term, which Cycles' lobe lacks; the ratio of the lobes is summed per pixel, at %d "
      "pixels.\n\n",
      blender_version(options.blender).c_str(), options.samples, options.size_px, comparison.face.size(),
      options.check_pixels);
  std::printf(
      "| map | kind | peak / mean | diffuse | specular, F = 1 | specular of skin | noise, diffuse | noise, specular |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|\n");
  double worst_diffuse = 0;
  double worst_specular = 0;
  for (const MapComparison& m : comparison.maps) {
    std::printf("| %s | %s | %.0f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", m.map.name.c_str(), m.map.kind.c_str(),
                m.map.peak_over_mean, 100 * m.diffuse.ours, 100 * m.glossy.ours, 100 * m.glossy.own_lobe,
                100 * m.diffuse.noise, 100 * m.glossy.noise);
    worst_diffuse = std::max(worst_diffuse, m.diffuse.ours);
    worst_specular = std::max({worst_specular, m.glossy.ours, m.glossy.own_lobe});
  }
  std::printf("\nWorst: diffuse %.2f %% (target 2: %s), specular %.2f %% (target 4: %s)\n", 100 * worst_diffuse,
              worst_diffuse <= kDiffuseTarget ? "met" : "MISSED", 100 * worst_specular,
              worst_specular <= kSpecularTarget ? "met" : "MISSED");

  std::printf(
      "\nIn between, at %d pixels: every texel summed, with a shadow ray each, against Cycles and against ours\n\n"
      "| map | sum - Cycles, diffuse | sum - Cycles, specular | ours - sum, diffuse | ours - sum, specular of skin |\n"
      "|---|---:|---:|---:|---:|\n",
      options.check_pixels);
  for (const MapComparison& m : comparison.maps) {
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f |\n", m.map.name.c_str(), 100 * m.diffuse.sum_cycles,
                100 * m.glossy.sum_cycles, 100 * m.diffuse.ours_sum, 100 * m.glossy.ours_sum);
  }
}

void print_lamp(const Comparison& comparison) {
  const MapComparison& lamp = comparison.lamp;
  const double ours = side_px(lamp.skin.diffuse, comparison.face);
  const double theirs = side_px(lamp.cycles_diffuse, comparison.face);
  std::printf(
      "\nA red lamp at camera right lights the same side in both: %s (its centre lies %+.1f px from the face's in "
      "ours, %+.1f px\n"
      "in Cycles; diffuse %.2f %%, specular %.2f %% apart)\n",
      ours > 1 && theirs > 1 ? "yes" : "NO", ours, theirs, 100 * lamp.diffuse.ours, 100 * lamp.glossy.ours);
}

void draw(const Comparison& comparison, const std::filesystem::path& folder) {
  for (const MapComparison& map : comparison.maps) draw_map(map, comparison.face, folder / (map.map.name + ".png"));
  draw_map(comparison.lamp, comparison.face, folder / "red_lamp.png");
}

}  // namespace faceprobe::bench
