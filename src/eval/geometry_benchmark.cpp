#include "faceprobe/eval/geometry_benchmark.h"

#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/angles.h"
#include "faceprobe/core/color.h"
#include "faceprobe/core/error.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faceprobe::eval {
namespace {

constexpr int kLeastPixels = 20;  // of a part of the face

Eigen::Vector3f vector_at(const Image& image, std::size_t pixel) {
  return Eigen::Map<const Eigen::Vector3f>(image.data() + 3 * pixel);
}

double degrees_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return degrees(std::atan2(static_cast<double>(a.cross(b).norm()), static_cast<double>(a.dot(b))));
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return quantile_of_sorted(values, 0.5);
}

struct StatedError {
  float stated_deg = 0;
  float true_deg = 0;
};

std::vector<CalibrationBin> calibration_of(std::vector<StatedError> errors) {
  constexpr std::size_t kBins = 10;
  std::sort(errors.begin(), errors.end(),
            [](const StatedError& a, const StatedError& b) { return a.stated_deg < b.stated_deg; });
  std::vector<CalibrationBin> bins(kBins);
  for (std::size_t b = 0; b < kBins; ++b) {
    const std::size_t first = errors.size() * b / kBins;
    const std::size_t last = errors.size() * (b + 1) / kBins;
    for (std::size_t i = first; i < last; ++i) {
      bins[b].stated_deg += static_cast<double>(errors[i].stated_deg);
      bins[b].true_deg += static_cast<double>(errors[i].true_deg);
    }
    const double count = std::max<double>(1, static_cast<double>(last - first));
    bins[b].stated_deg /= count;
    bins[b].true_deg /= count;
  }
  return bins;
}

struct Overlap {
  std::array<double, kRegionCount> both{}, either{};
  double skin_both = 0, skin_either = 0;

  void add(const ByteImage& found, const ByteImage& truth) {
    for (std::size_t i = 0; i < truth.values().size(); ++i) {
      const std::uint8_t a = found.data()[i];
      const std::uint8_t b = truth.data()[i];
      ++either[a];
      if (a == b) ++both[a];
      if (a != b) ++either[b];
      const bool skin_a = is_skin(static_cast<Region>(a));
      const bool skin_b = is_skin(static_cast<Region>(b));
      skin_both += skin_a && skin_b ? 1 : 0;
      skin_either += skin_a || skin_b ? 1 : 0;
    }
  }
};

// Of one method, gathered over the photos.
struct Gathered {
  std::vector<StatedError> stated;
  Overlap overlap;
  bool has_regions = false;
};

ScoreRow row_of(const GeometryMethod& method, int number, const SyntheticPhoto& photo, const GeometryEstimate& found,
                const ByteImage& judged, Gathered& gathered) {
  ScoreRow row{method.name, std::to_string(number), {{"tone", photo.tone()}, {"turn", photo.turn()}}, {}, photo.person};
  std::vector<double> all;
  std::array<std::vector<double>, kRegionCount> parts;
  const bool there = !found.normal_cam.empty();
  for (std::size_t i = 0; there && i < judged.values().size(); ++i) {
    if (judged.data()[i] == 0) continue;
    const double error = degrees_between(vector_at(found.normal_cam, i), vector_at(photo.view.normal, i));
    all.push_back(error);
    parts[photo.view.region.data()[i]].push_back(error);
    if (!found.normal_error_rad.empty()) {
      const double stated = degrees(static_cast<double>(found.normal_error_rad.data()[i]));
      gathered.stated.push_back({static_cast<float>(stated), static_cast<float>(error)});
    }
  }
  const double missing = std::numeric_limits<double>::quiet_NaN();
  row.metrics["normal"] = all.empty() ? missing : mean_of(all);
  row.metrics["normal_median"] = all.empty() ? missing : median_of(all);
  for (int r = 0; r < kRegionCount; ++r) {
    const std::vector<double>& part = parts[static_cast<std::size_t>(r)];
    if (part.size() >= kLeastPixels)
      row.metrics["normal_" + std::string(region_name(static_cast<Region>(r)))] = mean_of(part);
  }
  if (!found.region.empty()) {
    gathered.overlap.add(found.region, photo.view.region);
    gathered.has_regions = true;
  }
  return row;
}

// Skin for which every method that found the face has a normal.
ByteImage judged_pixels(const SyntheticPhoto& photo, const std::vector<GeometryEstimate>& found) {
  ByteImage judged = photo.skin;
  for (std::size_t i = 0; i < judged.values().size(); ++i) {
    if (vector_at(photo.view.normal, i).isZero()) judged.data()[i] = 0;
    for (const GeometryEstimate& estimate : found) {
      if (!estimate.normal_cam.empty() && vector_at(estimate.normal_cam, i).isZero()) judged.data()[i] = 0;
    }
  }
  return judged;
}

ByteImage normals_picture(const Image& normal) {
  ByteImage picture(normal.width(), normal.height(), 3);
  for (std::size_t i = 0; i < normal.pixel_count(); ++i) {
    const Eigen::Vector3f n = vector_at(normal, i);
    for (int c = 0; c < 3; ++c)
      picture.data()[3 * i + static_cast<std::size_t>(c)] =
          n.isZero() ? 0 : static_cast<std::uint8_t>(std::lround(127.5F + 127.5F * n[c]));
  }
  return picture;
}

ByteImage regions_picture(const ByteImage& region) {
  ByteImage picture(region.width(), region.height(), 3);
  for (std::size_t i = 0; i < region.values().size(); ++i) {
    const auto colour = region_colour(static_cast<Region>(region.data()[i]));
    std::copy(colour.begin(), colour.end(), picture.data() + 3 * i);
  }
  return picture;
}

}  // namespace

std::string GeometryBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  return {};
}

double GeometryScores::mean_overlap(const std::string& method) const {
  double sum = 0;
  int count = 0;
  for (const double overlap : region_overlap.at(method)) {
    if (!std::isfinite(overlap)) continue;
    sum += overlap;
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

GeometryScores measure_geometry(const synth::ShardReader& faces, const std::vector<GeometryMethod>& methods,
                                const GeometryBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  GeometryScores scores;
  scores.table.order_labels("tone", tone_names());
  scores.table.order_labels("turn", turn_names());
  std::vector<Gathered> gathered(methods.size());
  const std::vector<int> numbers = chosen_by_person(faces, options.samples);
  visit_photos(faces, numbers, options.progress, [&](int number, const SyntheticPhoto& photo) {
    std::vector<GeometryEstimate> found;
    found.reserve(methods.size());
    for (const GeometryMethod& method : methods) found.push_back(method.find(photo.input()));
    const ByteImage judged = judged_pixels(photo, found);
    for (std::size_t m = 0; m < methods.size(); ++m) {
      scores.table.add(row_of(methods[m], number, photo, found[m], judged, gathered[m]));
      scores.without_face[methods[m].name] += found[m].normal_cam.empty() ? 1 : 0;
    }
  });
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::string& name = methods[m].name;
    if (!gathered[m].stated.empty()) scores.calibration[name] = calibration_of(std::move(gathered[m].stated));
    if (!gathered[m].has_regions) continue;
    const Overlap& overlap = gathered[m].overlap;
    for (std::size_t r = 0; r < kRegionCount; ++r)
      scores.region_overlap[name][r] = overlap.both[r] / overlap.either[r];  // NaN where there is none
    scores.skin_overlap[name] = overlap.skin_both / overlap.skin_either;
  }
  return scores;
}

ByteImage draw_geometry(const synth::ShardReader& faces, const std::vector<GeometryMethod>& methods, int rows) {
  ByteImage sheet;
  int row = 0;
  for (const int number : chosen_by_person(faces, rows)) {
    const SyntheticPhoto photo(faces, number);
    std::vector<ByteImage> cells = {photo.sample.photo, normals_picture(photo.view.normal),
                                    regions_picture(photo.view.region)};
    const int width = photo.sample.photo.width();
    const int height = photo.sample.photo.height();
    for (const GeometryMethod& method : methods) {
      const GeometryEstimate found = method.find(photo.input());
      cells.push_back(found.normal_cam.empty() ? ByteImage(width, height, 3) : normals_picture(found.normal_cam));
      cells.push_back(found.region.empty() ? ByteImage(width, height, 3) : regions_picture(found.region));
    }
    if (sheet.empty()) sheet = ByteImage(static_cast<int>(cells.size()) * width, rows * height, 3);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      for (int y = 0; y < height; ++y)
        std::copy_n(cells[c].pixel(0, y), 3 * width, sheet.pixel(static_cast<int>(c) * width, row * height + y));
    }
    ++row;
  }
  return sheet;
}

TrustThirds thirds_of(const std::vector<CalibrationBin>& bins) {
  const double third = static_cast<double>(bins.size()) / 3;
  const auto mean_from = [&](bool from_the_end) {
    double sum = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      const double share = std::clamp(third - static_cast<double>(i), 0.0, 1.0);
      sum += share * bins[from_the_end ? bins.size() - 1 - i : i].true_deg;
    }
    return sum / third;  // 0 / 0 without bins
  };
  return {mean_from(false), mean_from(true)};
}

}  // namespace faceprobe::eval
