#include "faceprobe/eval/room_benchmark.h"

#include "eval/nan.h"
#include "eval/photo_choice.h"
#include "eval/synthetic_photo.h"
#include "faceprobe/core/error.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace faceprobe::eval {
namespace {

constexpr double kChiSquare95 = 7.815;  // three degrees of freedom
constexpr double kMostFaceMatch_px =
    30;  // per 384 px of the picture: a found face is the true one nearest to it in the photo

Eigen::Vector2d pixel_of(const face::Camera& camera, const Eigen::Vector3d& place) { return camera.project(place); }

// Of each found face the true one it is, or -1; no true one is two.
std::vector<int> match_faces(const std::vector<lighting::FaceLights>& found, const synth::ViewLayers& view,
                             const face::Camera& camera) {
  std::vector<int> match;
  const double most = kMostFaceMatch_px * view.region.width() / 384.0;
  for (const lighting::FaceLights& face : found) {
    int best = -1;
    double nearest = most;
    for (int i = 0; i < static_cast<int>(view.faces.size()); ++i) {
      const Eigen::Vector3d truth =
          view.faces[static_cast<std::size_t>(i)].camera_from_head.translation().cast<double>();
      const double distance = (pixel_of(camera, truth) - pixel_of(camera, face.position_m)).norm();
      if (distance >= nearest || std::ranges::count(match, i) > 0) continue;
      best = i;
      nearest = distance;
    }
    match.push_back(best);
  }
  return match;
}

// Greedy, nearest pairs first: index of the found lamp of each true one, or -1.
std::vector<int> match_lamps(const std::vector<synth::NearLight>& truth, const std::vector<lighting::Lamp>& found,
                             double most_m) {
  std::vector<int> match(truth.size(), -1);
  std::vector<bool> used(found.size(), false);
  while (true) {
    double nearest = most_m;
    std::pair<std::size_t, std::size_t> best;
    bool any = false;
    for (std::size_t t = 0; t < truth.size(); ++t) {
      for (std::size_t f = 0; f < found.size(); ++f) {
        if (match[t] >= 0 || used[f] || !found[f].near) continue;
        const double distance = (found[f].position_m - truth[t].position.cast<double>()).norm();
        if (distance >= nearest) continue;
        nearest = distance;
        best = {t, f};
        any = true;
      }
    }
    if (!any) return match;
    match[best.first] = static_cast<int>(best.second);
    used[best.second] = true;
  }
}

// `group`: the people in the photo, whose lamps and faces are not independent.
void add_lamps(const std::string& method, const std::string& sample, const std::string& group,
               const std::vector<synth::NearLight>& truth, const std::vector<lighting::Lamp>& found,
               const RoomBenchmark& options, ScoreTable& table) {
  const std::vector<int> match = match_lamps(truth, found, options.most_match_m);
  int matched = 0;
  for (std::size_t t = 0; t < truth.size(); ++t) {
    std::map<std::string, double> metrics = {{"lamp_m", kNaN}, {"covered", kNaN}, {"found", 0}, {"within", 0}};
    if (match[t] >= 0) {
      ++matched;
      const lighting::Lamp& lamp = found[static_cast<std::size_t>(match[t])];
      const Eigen::Vector3d off = lamp.position_m - truth[t].position.cast<double>();
      metrics["lamp_m"] = off.norm();
      metrics["covered"] = off.dot(lamp.covariance_m2.inverse() * off) < kChiSquare95 ? 1 : 0;
      metrics["found"] = 1;
      metrics["within"] = off.norm() <= options.near_m ? 1 : 0;
    }
    table.add({method, sample + " lamp " + std::to_string(t + 1), {}, metrics, group});
  }
  int near = 0;
  for (const lighting::Lamp& lamp : found) near += lamp.near ? 1 : 0;
  const int invented = near - matched;
  table.add(
      {method, sample, {}, {{"invented", static_cast<double>(invented)}, {"inventing", invented > 0 ? 1.0 : 0.0}}, group});
}

}  // namespace

std::string RoomBenchmark::validate() const {
  if (samples < 1 || samples > 1'000'000) return "samples is " + std::to_string(samples) + "; allowed is 1 to 1000000.";
  if (!(near_m > 0 && near_m < 1e6)) return "near_m must be positive.";
  if (!(most_match_m > 0 && most_match_m < 1e6)) return "most_match_m must be positive.";
  return triangulate.validate();
}

ScoreTable measure_rooms(const synth::ShardReader& groups, const LookAtGroup& look, const RoomBenchmark& options) {
  if (const std::string problem = options.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  ScoreTable table;
  const std::vector<int> numbers = evenly_chosen(groups, options.samples);
  int done = 0;
  for (const int number : numbers) {
    const SyntheticPhoto photo(groups, number);
    const std::string sample = std::to_string(number);
    if (photo.view.faces.size() >= 2) {
      std::vector<lighting::FaceLights> faces = look(photo.input());
      const std::vector<int> match = match_faces(faces, photo.view, photo.input().camera);
      add_lamps("faces as found", sample, photo.person, photo.sample.lamps,
                lighting::triangulate(faces, options.triangulate), options, table);
      for (std::size_t t = 0; t < photo.view.faces.size(); ++t) {
        const auto f = static_cast<std::size_t>(std::ranges::find(match, static_cast<int>(t)) - match.begin());
        std::map<std::string, double> metrics = {{"face_m", kNaN}, {"face_found", 0}};
        if (f < faces.size()) {
          const Eigen::Vector3d truth = photo.view.faces[t].camera_from_head.translation().cast<double>();
          metrics = {{"face_m", (faces[f].position_m - truth).norm()}, {"face_found", 1}};
          faces[f].position_m = truth;
          faces[f].position_error_m = 1e-3;
        }
        table.add({"faces as found", sample + " face " + std::to_string(t + 1), {}, metrics, photo.person});
      }
      add_lamps("faces known", sample, photo.person, photo.sample.lamps,
                lighting::triangulate(faces, options.triangulate), options, table);
    }
    if (options.progress) options.progress(++done, static_cast<int>(numbers.size()));
  }
  return table;
}

}  // namespace faceprobe::eval
