#include "faceprobe/eval/shading_benchmark.h"

#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>

namespace faceprobe::eval {
namespace {

ByteImage judged_pixels(const SyntheticPhoto& photo) {
  constexpr float kDark = 1e-3F;  // of the shading: nothing is to be seen there
  ByteImage judged = photo.skin;
  for (std::size_t i = 0; i < judged.values().size(); ++i) {
    const float* shading = photo.sample.shading.data() + 3 * i;
    if (photo.sample.clip.data()[i] != 0 || std::min({shading[0], shading[1], shading[2]}) < kDark)
      judged.data()[i] = 0;
  }
  return judged;
}

Eigen::Vector3d sum_over(const Image& image, const ByteImage& mask) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < mask.values().size(); ++i) {
    if (mask.data()[i] != 0) sum += Eigen::Map<const Eigen::Vector3f>(image.data() + 3 * i).cast<double>();
  }
  return sum;
}

double colour_error_deg(const Image& estimate, const Image& truth, const ByteImage& mask) {
  const Eigen::Vector3d a = sum_over(estimate, mask);
  const Eigen::Vector3d b = sum_over(truth, mask);
  return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

}  // namespace

ShadingMethod one_albedo_method() {
  return {"one albedo", [](const PhotoInput& input) {
            return ShadingEstimate{Image(input.linear.width(), input.linear.height(), 3, 0.35F), input.linear};
          }};
}

std::string ShadingBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

double scale_invariant_error(const Image& estimate, const Image& truth, const ByteImage& mask) {
  double ee = 0;
  double et = 0;
  double tt = 0;
  for (std::size_t i = 0; i < truth.values().size(); ++i) {
    if (mask.data()[i / 3] == 0) continue;
    const auto e = static_cast<double>(estimate.data()[i]);
    const auto t = static_cast<double>(truth.data()[i]);
    ee += e * e;
    et += e * t;
    tt += t * t;
  }
  if (tt <= 0) return std::nan("");
  if (ee <= 0) return 1;
  return std::sqrt(std::max(0.0, 1 - et * et / (ee * tt)));
}

ScoreTable measure_shading(const synth::ShardReader& faces, const std::vector<ShadingMethod>& methods,
                           const ShadingBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  ScoreTable table;
  table.order_labels("tone", tone_names());
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    const ByteImage judged = judged_pixels(photo);
    for (const ShadingMethod& method : methods) {
      const ShadingEstimate found = method.split(photo.input());
      table.add({method.name,
                 std::to_string(number),
                 {{"tone", photo.tone()}},
                 {{"albedo", scale_invariant_error(found.albedo, photo.sample.albedo, judged)},
                  {"shading", scale_invariant_error(found.shading, photo.sample.shading, judged)},
                  {"light_colour", colour_error_deg(found.shading, photo.sample.shading, judged)}},
                 photo.person});
    }
  });
  return table;
}

}  // namespace faceprobe::eval
