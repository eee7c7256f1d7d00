#include "faceprobe/assets/reflectance_statistics.h"

#include "assets/array.h"
#include "assets/mat_file.h"

#include <cmath>

namespace faceprobe::assets {
namespace {

// The file's numbers of the regions. 3 and 7 are brows and lips, whose order is not documented publicly; 10 is not painted in the
// published picture of the regions, so it is the rest.
constexpr std::array<Region, 10> kRegions = {Region::kUpperLip, Region::kForehead, Region::kBrows, Region::kEyelids,
                                             Region::kNose,     Region::kCheeks,   Region::kLips,  Region::kChin,
                                             Region::kJaw,      Region::kOther};

// Welford's running mean and sum of squares.
struct Running {
  int count = 0;
  Eigen::Array2d mean = Eigen::Array2d::Zero(), squares = Eigen::Array2d::Zero();

  void add(const Eigen::Array2d& value) {
    ++count;
    const Eigen::Array2d before = value - mean;
    mean += before / count;
    squares += before * (value - mean);
  }
  RegionReflectance finished() const {
    const Eigen::Array2d deviation = count > 1 ? Eigen::Array2d((squares / (count - 1)).sqrt()) : Eigen::Array2d::Zero();
    return {count, mean(0), deviation(0), mean(1), deviation(1)};
  }
};
using RunningTable = std::array<Running, 10>;

RegionTable finished(const RunningTable& table) {
  RegionTable result;
  for (std::size_t i = 0; i < table.size(); ++i) result[i] = table[i].finished();
  return result;
}

int whole_number(const Eigen::VectorXf& values, Eigen::Index i, int last, const std::string& what) {
  const float value = values(i);
  if (!(value >= 1 && value <= static_cast<float>(last)) || value != std::floor(value)) {
    refuse_input(what + " holds " + std::to_string(value) + "; whole numbers from 1 to " + std::to_string(last) +
                 " are allowed.");
  }
  return static_cast<int>(value);
}

}  // namespace

const RegionReflectance* ReflectanceStatistics::of(Region region) const {
  for (std::size_t i = 0; i < kRegions.size(); ++i) {
    if (kRegions[i] == region && all[i].count > 0) return &all[i];
  }
  return nullptr;
}

ReflectanceStatistics load_reflectance_statistics(const std::filesystem::path& path) {
  const MatFile file(path);
  const Eigen::MatrixXf samples = file.matrix("ts", -1, 2);  // m, rho_s
  const Eigen::VectorXf region = file.vector("ts_region", samples.rows());
  const Eigen::VectorXf subject = file.vector("ts_subjec", samples.rows());  // the file's own spelling
  const Eigen::VectorXf skin_type = file.vector("subj_skintype");
  ReflectanceStatistics statistics;
  RunningTable all;
  std::map<int, RunningTable> by_type;
  for (Eigen::Index i = 0; i < samples.rows(); ++i) {
    const auto row = static_cast<std::size_t>(whole_number(region, i, 10, file.name() + ": 'ts_region'") - 1);
    const int person = whole_number(subject, i, static_cast<int>(skin_type.size()), file.name() + ": 'ts_subjec'");
    const int type = whole_number(skin_type, person - 1, 6, file.name() + ": 'subj_skintype'");
    if (!samples.row(i).allFinite()) {
      ++statistics.skipped;
      continue;
    }
    const Eigen::Array2d value = samples.row(i).transpose().cast<double>();
    all[row].add(value);
    by_type[type][row].add(value);
  }
  statistics.all = finished(all);
  for (const auto& [type, table] : by_type) statistics.by_skin_type[type] = finished(table);
  return statistics;
}

synth::SkinStatistics skin_statistics(const ReflectanceStatistics& statistics) {
  synth::SkinStatistics result;
  for (int r = 0; r < kSkinRegionCount; ++r) {
    const RegionReflectance* region = statistics.of(static_cast<Region>(r + 1));
    if (region == nullptr) continue;
    result.regions[static_cast<std::size_t>(r)] = {
        static_cast<float>(region->mean_roughness), static_cast<float>(region->roughness_deviation),
        static_cast<float>(region->mean_specular_albedo), static_cast<float>(region->specular_albedo_deviation), true};
  }
  return result;
}

}  // namespace faceprobe::assets
