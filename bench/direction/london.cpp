#include "direction/direction.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/estimate.h"
#include "support/light_direction.h"
#include "support/photos.h"
#include "support/statistics.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace faceprobe::bench {

namespace {

using highlight::Separator;
using lighting::Solver;
using pipeline::NormalSource;
using pipeline::ShadingSource;

std::vector<Eigen::Vector3d> read_lights(const std::filesystem::path& file) {
  std::ifstream stream(file);
  const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
  if (json.is_discarded()) throw Error(ExitCode::kInput, file.string() + " is missing or no JSON.");
  std::vector<Eigen::Vector3d> lights;
  for (const auto& light : json.at("lights")) {
    const auto direction = light.at("direction_x_right_y_up_z_to_camera").get<std::array<double, 3>>();
    lights.push_back(Eigen::Vector3d(direction[0], direction[1], direction[2]).normalized());
  }
  return lights;
}

struct Person {
  std::string id;
  std::filesystem::path neutral, smiling;
};

std::vector<Person> people_in(const std::filesystem::path& folder) {
  std::map<std::string, Person> people;
  const auto id_of = [](const std::filesystem::path& file) { return file.stem().string().substr(0, 3); };
  for (const auto& file : photos_below(folder / "neutral_front")) people[id_of(file)].neutral = file;
  for (const auto& file : photos_below(folder / "smiling_front")) people[id_of(file)].smiling = file;
  std::vector<Person> both;
  for (auto& [id, person] : people) {
    person.id = id;
    if (!person.neutral.empty() && !person.smiling.empty()) both.push_back(person);
  }
  return both;
}

struct Measured {
  std::vector<Eigen::Vector3d> lights;  // strongest first; never empty
  Eigen::Vector3d centroid;
};

struct Row {
  std::string name;
  std::vector<Measured> neutral, smiling;  // one per person
};

std::string angles_text(const Eigen::Vector3d& direction) {
  return cell(azimuth_deg(direction), 0) + " / " + cell(elevation_deg(direction), 0);
}

void print(const Row& row, const std::vector<Eigen::Vector3d>& truth) {
  std::vector<double> strongest, recall, precision, count, spread, expression;
  std::vector<Eigen::Vector3d> centroids;
  for (const auto* set : {&row.neutral, &row.smiling}) {
    for (const Measured& photo : *set) {
      strongest.push_back(nearest_deg(photo.lights.front(), truth));
      count.push_back(static_cast<double>(photo.lights.size()));
      std::vector<double> to_estimate, to_truth;
      for (const Eigen::Vector3d& light : truth) to_estimate.push_back(nearest_deg(light, photo.lights));
      for (const Eigen::Vector3d& light : photo.lights) to_truth.push_back(nearest_deg(light, truth));
      recall.push_back(mean(to_estimate));
      precision.push_back(mean(to_truth));
      centroids.push_back(photo.centroid);
    }
  }
  const std::optional<Eigen::Vector3d> centre = mean_direction(centroids);
  for (const Eigen::Vector3d& centroid : centroids) {
    if (centre) spread.push_back(angle_between_deg(centroid, *centre));
  }
  for (std::size_t i = 0; i < row.neutral.size(); ++i) {
    expression.push_back(angle_between_deg(row.neutral[i].centroid, row.smiling[i].centroid));
  }
  std::printf("| %s | %zu | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", row.name.c_str(), strongest.size(),
              cell(mean(strongest)).c_str(), cell(median(strongest)).c_str(), cell(mean(recall)).c_str(),
              cell(mean(precision)).c_str(), cell(mean(count)).c_str(), centre ? angles_text(*centre).c_str() : "-",
              cell(mean(spread)).c_str(), cell(quantile(spread, 0.9)).c_str(), cell(mean(expression)).c_str());
}

struct Setting {
  std::string name;
  pipeline::Estimator estimator;
};

std::vector<Setting> settings(const pipeline::EstimateOptions& base) {
  std::vector<Setting> all;
  for (const Solver solver : {Solver::kTransport, Solver::kPaper}) {
    for (const std::optional<Separator> classical : {std::optional<Separator>(), std::optional(Separator::kTan),
                                                     std::optional(Separator::kYang), std::optional(Separator::kShen)}) {
      pipeline::EstimateOptions options = base;
      options.solve.solver = solver;
      options.classical = classical;
      all.push_back(
          {std::string(lighting::solver_name(solver)) + ", " + options.separator_name(), pipeline::Estimator(options)});
    }
  }
  // What the prior is worth, and without it the network's normals and shading, one by one.
  for (const NormalSource normals : {NormalSource::kMesh, NormalSource::kNet}) {
    for (const ShadingSource shading : {ShadingSource::kRegions, ShadingSource::kNet}) {
      pipeline::EstimateOptions options = base;
      options.normals = normals;
      options.shading = shading;
      options.prior = pipeline::PriorSource::kSmooth;
      all.push_back({std::string("transport, net, without the prior, normals of the ") +
                         (normals == NormalSource::kNet ? "net" : "mesh") + ", shading by " +
                         (shading == ShadingSource::kNet ? "net" : "region"),
                     pipeline::Estimator(options)});
    }
  }
  return all;
}

// Empty when there is no face or the light says nothing about direction.
std::optional<Measured> measure(const pipeline::Estimator& estimator, const io::Photo& photo) {
  try {
    const pipeline::Estimate estimate = estimator.estimate(photo);
    const pipeline::FaceEstimate& face = estimate.faces[estimate.largest];
    const std::vector<Eigen::Vector3d> lights = light_directions(face);
    const std::optional<Eigen::Vector3d> centroid = energy_centroid(face);
    if (lights.empty() || !centroid) return std::nullopt;
    return Measured{lights, *centroid};
  } catch (const Error& error) {
    if (error.code() != ExitCode::kNoFace) throw;
    return std::nullopt;
  }
}

}  // namespace

void report_london(const std::filesystem::path& folder, int every, const pipeline::EstimateOptions& base) {
  const std::vector<Eigen::Vector3d> truth = read_lights(folder / "lights_from_catchlights.json");
  const std::vector<Person> people = every_nth(people_in(folder), every);
  const std::vector<Setting> all = settings(base);
  // What no look at the photo gives: a light straight ahead.
  const Measured ahead{{Eigen::Vector3d::UnitZ()}, Eigen::Vector3d::UnitZ()};
  const std::vector<Measured> aheads(people.size(), ahead);
  std::vector<Row> rows = {{"straight ahead, no estimate", aheads, aheads}};
  for (const Setting& setting : all) rows.push_back({setting.name, {}, {}});
  for (const Person& person : people) {
    const io::Photo neutral = io::load_photo(person.neutral);
    const io::Photo smiling = io::load_photo(person.smiling);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const std::optional<Measured> first = measure(all[k].estimator, neutral);
      const std::optional<Measured> second = measure(all[k].estimator, smiling);
      if (!first || !second) continue;
      rows[k + 1].neutral.push_back(*first);
      rows[k + 1].smiling.push_back(*second);
    }
  }
  std::printf(
      "\n### London: three studio lights\n\nAngles in degrees; %zu people, each neutral and smiling. Azimuth / "
      "elevation of the"
      " lights:",
      people.size());
  for (std::size_t i = 0; i < truth.size(); ++i) std::printf("%s %s", i > 0 ? "," : "", angles_text(truth[i]).c_str());
  std::printf(
      "; they are known to about 5 degrees. A person counts when both photos have an answer. Many lights make it easy "
      "to have"
      " one near each true light, so the next column asks the other way round; and a constant answer agrees with "
      "itself,"
      " so agreement counts only beside a small error.\n\n");
  std::printf(
      "| estimate | photos | strongest to nearest true: mean | median | true to nearest estimated | estimated to "
      "nearest"
      " true | lights | mean centroid | centroids off it: mean | 90 %% | neutral to smiling |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const Row& row : rows) print(row, truth);
}

}  // namespace faceprobe::bench
