#include "paper/london.h"

#include "faceprobe/core/angles.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/largest_face.h"
#include "paper/light_direction.h"

#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace faceprobe::cli {

namespace {

constexpr std::array<const char*, 2> kExpressions = {"neutral", "smiling"};

struct LondonAnswer {
  std::vector<Eigen::Vector3d> lights;  // strongest first; never empty
  Eigen::Vector3d centroid;
  Eigen::VectorXd map;  // luminances; empty = none
};
using BothAnswers = std::optional<std::array<LondonAnswer, 2>>;  // neutral, smiling

// Empty when the light says nothing about direction.
std::optional<LondonAnswer> london_answer(const pipeline::LightResult& result) {
  const std::vector<Eigen::Vector3d> lights = light_directions(result);
  const std::optional<Eigen::Vector3d> centroid = energy_centroid(result);
  if (lights.empty() || !centroid) return std::nullopt;
  return LondonAnswer{lights, *centroid, luminances(result.light)};
}

using LondonAnswers = std::vector<std::optional<LondonAnswer>>;

// Of every setting, then of every rival on the first setting's estimate.
LondonAnswers answers_to(const io::Photo& photo, const std::vector<pipeline::Estimator>& estimators,
                         const std::vector<FaceLightMethod>& rivals) {
  LondonAnswers own;
  LondonAnswers theirs;
  for (const pipeline::Estimator& estimator : estimators) {
    const std::optional<pipeline::FaceEstimate> face = pipeline::find_largest_face(estimator, photo);
    own.push_back(face ? london_answer(*face) : std::nullopt);
    if (!theirs.empty()) continue;
    for (const FaceLightMethod& rival : rivals) {
      Eigen::MatrixX3f found = face ? rival.light({*face, photo.linear}) : Eigen::MatrixX3f();
      theirs.push_back(found.size() > 0 ? london_answer(result_of(std::move(found))) : std::nullopt);
    }
  }
  own.insert(own.end(), std::make_move_iterator(theirs.begin()), std::make_move_iterator(theirs.end()));
  return own;
}

double mean_nearest_deg(const std::vector<Eigen::Vector3d>& from, const std::vector<Eigen::Vector3d>& to) {
  const double sum = std::accumulate(from.begin(), from.end(), 0.0, [&](double total, const Eigen::Vector3d& light) {
    return total + nearest_deg(light, to);
  });
  return sum / static_cast<double>(from.size());
}

// In the order of the answers, neutral before smiling; empty where there are no maps.
std::vector<double> agreements(const std::vector<BothAnswers>& people) {
  std::vector<const Eigen::VectorXd*> maps;
  std::vector<int> person;
  for (std::size_t p = 0; p < people.size(); ++p) {
    if (!people[p]) continue;
    for (const LondonAnswer& answer : *people[p]) {
      if (answer.map.size() == 0) return {};
      maps.push_back(&answer.map);
      person.push_back(static_cast<int>(p));
    }
  }
  if (maps.empty()) return {};
  Eigen::MatrixXd all(maps.front()->size(), static_cast<Eigen::Index>(maps.size()));
  for (std::size_t i = 0; i < maps.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = *maps[i];
  return agreement_with_others(all, person);
}

std::optional<Eigen::Vector3d> centre_of(const std::vector<BothAnswers>& people) {
  std::vector<Eigen::Vector3d> centroids;
  for (const BothAnswers& both : people) {
    if (both) centroids.insert(centroids.end(), {both->front().centroid, both->back().centroid});
  }
  return mean_direction(centroids);
}

std::map<std::string, double> no_answer(std::size_t expression) {
  std::map<std::string, double> metrics;
  for (const char* name : {"strongest_deg", "recall_deg", "precision_deg", "lights", "centroid_x", "centroid_y",
                           "centroid_z", "centroid_off_deg", "map_correlation"})
    metrics[name] = std::numeric_limits<double>::quiet_NaN();
  if (expression == 1) metrics["neutral_to_smiling_deg"] = std::numeric_limits<double>::quiet_NaN();
  return metrics;
}

// `constant`: whether all answers are one, whose agreement says nothing.
void add_rows(const std::string& name, bool constant, const LondonSet& london, const std::vector<BothAnswers>& people,
              eval::ScoreTable& scores) {
  const std::optional<Eigen::Vector3d> centre = centre_of(people);
  const std::vector<double> agreement = agreements(people);
  std::size_t answered = 0;
  for (std::size_t p = 0; p < people.size(); ++p) {
    const LondonPerson& person = london.people[p];
    for (std::size_t e = 0; e < kExpressions.size(); ++e) {
      std::map<std::string, double> metrics = no_answer(e);
      if (people[p]) {
        const LondonAnswer& answer = (*people[p])[e];
        metrics["strongest_deg"] = nearest_deg(answer.lights.front(), london.lights);
        metrics["recall_deg"] = mean_nearest_deg(london.lights, answer.lights);
        metrics["precision_deg"] = mean_nearest_deg(answer.lights, london.lights);
        metrics["lights"] = static_cast<double>(answer.lights.size());
        metrics["centroid_x"] = answer.centroid.x();
        metrics["centroid_y"] = answer.centroid.y();
        metrics["centroid_z"] = answer.centroid.z();
        if (centre) metrics["centroid_off_deg"] = angle_between_deg(answer.centroid, *centre);
        if (!agreement.empty()) metrics["map_correlation"] = agreement[answered];
        if (e == 1) metrics["neutral_to_smiling_deg"] = angle_between_deg((*people[p])[0].centroid, answer.centroid);
        ++answered;
      }
      if (constant) metrics.erase("map_correlation");
      std::map<std::string, std::string> groups = {{"expression", kExpressions[e]}};
      if (!person.ethnicity.empty()) groups["ethnicity"] = person.ethnicity;
      scores.add({name, person.id + " " + kExpressions[e], std::move(groups), std::move(metrics), person.id});
    }
  }
}

}  // namespace

eval::ScoreTable measure_london(const LondonSet& london, const std::vector<DirectionSetting>& settings,
                                const PhotoDone& done, const std::vector<FaceLightMethod>& rivals) {
  const std::vector<pipeline::Estimator> estimators = estimators_of(settings);
  const std::size_t count = settings.empty() ? 0 : settings.size() + rivals.size();
  std::vector<std::vector<BothAnswers>> answers(count);
  for (const LondonPerson& person : london.people) {
    LondonAnswers neutral = answers_to(io::load_photo(person.neutral), estimators, rivals);
    if (done) done();
    LondonAnswers smiling = answers_to(io::load_photo(person.smiling), estimators, rivals);
    for (std::size_t k = 0; k < count; ++k) {
      answers[k].emplace_back();
      if (neutral[k] && smiling[k]) answers[k].back() = {std::move(*neutral[k]), std::move(*smiling[k])};
    }
    if (done) done();
  }
  eval::ScoreTable scores;
  scores.order_labels("expression", {kExpressions.begin(), kExpressions.end()});
  // What no look at the photo gives.
  const LondonAnswer ahead{{Eigen::Vector3d::UnitZ()}, Eigen::Vector3d::UnitZ(), {}};
  add_rows(kStraightAhead, true, london,
           std::vector<BothAnswers>(london.people.size(), std::array<LondonAnswer, 2>{ahead, ahead}), scores);
  for (std::size_t k = 0; k < count; ++k) {
    if (k < settings.size()) {
      add_rows(settings[k].name, false, london, answers[k], scores);
    } else {
      const FaceLightMethod& rival = rivals[k - settings.size()];
      add_rows(rival.name, rival.constant, london, answers[k], scores);
    }
  }
  return scores;
}

}  // namespace faceprobe::cli
