// bench_robustness --data DIR: the whole way, photo to light, on many kinds of photo. Nothing may throw but "no face", and
// nothing may come out that is not a number. Prints one Markdown table per solver and the list of failures; ends with 1 when a
// bar is missed:
//   - no errors and no broken values, in either solver (`paper` runs on every fifth photo);
//   - a face in at least 98 % of the portraits made for it (London, selfies), none in the pictures without;
//   - in group pictures (NAME_multi.jpg) at least as many faces over 60 px as the data's index lists.

#include "faceprobe/core/error.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/pipeline/estimate.h"
#include "paper/csv.h"
#include "support/photos.h"
#include "support/sanity.h"
#include "support/statistics.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using namespace faceprobe;

constexpr double kFaceShare = 0.98;
constexpr float kListedFacePx = 60;  // as FinderOptions::min_face_px
constexpr int kPaperEvery = 5;

struct Outcome {
  std::string set;   // folder under DIR/real
  std::string name;  // file
  int faces = 0;
  int large_faces = 0;  // over kListedFacePx
  double seconds = 0;
  std::string error;                // sentence, empty when all went well or there was no face
  std::vector<std::string> broken;  // parts with impossible values
};

Outcome run_photo(const fs::path& file, const fs::path& real, const pipeline::Estimator& estimator) {
  Outcome outcome;
  outcome.set = fs::relative(file.parent_path(), real).string();
  outcome.name = file.filename().string();
  const auto start = std::chrono::steady_clock::now();
  try {
    const pipeline::Estimate estimate = estimator.estimate(io::load_photo(file));
    outcome.faces = static_cast<int>(estimate.faces.size());
    for (const pipeline::FaceEstimate& face : estimate.faces)
      outcome.large_faces += face.face.box.width >= kListedFacePx;
    outcome.broken = bench::broken_parts(estimate);
  } catch (const Error& error) {
    if (error.code() != ExitCode::kNoFace) outcome.error = bench::without_folder(error.what(), real, "DIR/real");
  } catch (const std::exception& error) {
    outcome.error = "not a faceprobe::Error: " + bench::without_folder(error.what(), real, "DIR/real");
  }
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

std::vector<Outcome> run_all(const std::vector<fs::path>& photos, const fs::path& real, lighting::Solver solver) {
  pipeline::EstimateOptions options;
  options.solve.solver = solver;
  const pipeline::Estimator estimator(options);
  std::vector<Outcome> outcomes;
  for (const fs::path& photo : photos) outcomes.push_back(run_photo(photo, real, estimator));
  return outcomes;
}

// The data's own notes on real/hardcases: photos it knows, and the faces in each.
struct Index {
  std::map<std::string, int> faces;  // by file

  int absent(const fs::path& folder) const {
    return static_cast<int>(std::count_if(faces.begin(), faces.end(),
                                          [&](const auto& entry) { return !fs::exists(folder / entry.first); }));
  }
};

Index read_index(const fs::path& file) {
  Index index;
  if (!fs::exists(file)) return index;
  const cli::CsvTable table = cli::read_csv(file);
  const std::size_t name = table.column("file");
  const std::size_t faces = table.column("faces_found");
  for (const auto& row : table.rows) index.faces[row[name]] = std::stoi(row[faces]);
  return index;
}

void print_table(const std::vector<Outcome>& outcomes, const Index& index, const fs::path& real) {
  std::map<std::string, std::vector<const Outcome*>> sets;
  for (const Outcome& outcome : outcomes) sets[outcome.set].push_back(&outcome);
  std::printf("| set | photos | absent | with a face | errors | broken values | median s |\n");
  std::printf("| --- | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  for (const auto& [set, members] : sets) {
    int with_face = 0, errors = 0, broken = 0;
    std::vector<double> seconds;
    for (const Outcome* outcome : members) {
      with_face += outcome->faces > 0;
      errors += !outcome->error.empty();
      broken += !outcome->broken.empty();
      seconds.push_back(outcome->seconds);
    }
    const int absent = set == "hardcases" ? index.absent(real / set) : 0;
    std::printf("| %s | %zu | %d | %d | %d | %d | %.2f |\n", set.c_str(), members.size(), absent, with_face, errors,
                broken, bench::median(seconds));
  }
}

bool is_portrait_set(const std::string& set) {
  return set.find("london") != std::string::npos || set.find("selfies") != std::string::npos;
}

// Sentences, one per bar missed.
std::vector<std::string> missed_bars(const std::vector<Outcome>& outcomes, const Index& index) {
  std::vector<std::string> missed;
  int portraits = 0, found = 0;
  for (const Outcome& outcome : outcomes) {
    const std::string photo = outcome.set + "/" + outcome.name;
    if (!outcome.error.empty()) missed.push_back(photo + ": " + outcome.error);
    for (const std::string& part : outcome.broken) missed.push_back(photo + ": broken values in " + part);
    if (is_portrait_set(outcome.set)) {
      ++portraits;
      found += outcome.faces > 0;
    }
    if (outcome.set.find("nonface") != std::string::npos && outcome.faces > 0) {
      missed.push_back(photo + ": a face where there is none");
    }
    const auto listed = index.faces.find(outcome.name);
    if (outcome.set == "hardcases" && listed != index.faces.end() && outcome.large_faces < listed->second &&
        outcome.name.find("_multi.") != std::string::npos) {
      missed.push_back(photo + ": " + std::to_string(outcome.large_faces) + " faces over 60 px, listed are " +
                       std::to_string(listed->second));
    }
  }
  if (portraits > 0 && found < kFaceShare * portraits) {
    missed.push_back("London and selfies: a face in " + std::to_string(found) + " of " + std::to_string(portraits));
  }
  return missed;
}

// Not bars: portraits and hard cases in which nobody was found.
void print_faceless(const std::vector<Outcome>& outcomes) {
  std::printf("\nNo face found, outside nonface sets:");
  bool any = false;
  for (const Outcome& outcome : outcomes) {
    if (outcome.faces > 0 || !outcome.error.empty() || outcome.set.find("nonface") != std::string::npos) continue;
    std::printf("%s %s", any ? "," : "", outcome.name.c_str());
    any = true;
  }
  std::printf("%s.\n", any ? "" : " none");
}

int run(const fs::path& data, int every) {
  const fs::path real = data / "real";
  std::vector<fs::path> photos = bench::photos_below(real / "portraits");
  const std::vector<fs::path> hard = bench::photos_below(real / "hardcases");
  photos.insert(photos.end(), hard.begin(), hard.end());
  if (photos.empty())
    throw Error(ExitCode::kInput, "There are no photos in real/portraits or real/hardcases of the data folder.");
  photos = bench::every_nth(photos, every);
  const Index index = read_index(real / "hardcases" / "index.csv");

  std::vector<std::string> missed;
  for (const lighting::Solver solver : {lighting::Solver::kTransport, lighting::Solver::kPaper}) {
    const bool paper = solver == lighting::Solver::kPaper;
    const auto outcomes = run_all(paper ? bench::every_nth(photos, kPaperEvery) : photos, real, solver);
    std::printf("%sSolver `%s`, %zu photos:\n\n", paper ? "\n" : "", std::string(lighting::solver_name(solver)).c_str(),
                outcomes.size());
    print_table(outcomes, index, real);
    print_faceless(outcomes);
    for (const std::string& sentence : missed_bars(outcomes, index)) missed.push_back(sentence);
  }
  const auto groups = std::count_if(photos.begin(), photos.end(),
                                    [](const fs::path& photo) { return photo.stem().string().ends_with("_multi"); });
  std::printf("\nGroup pictures among the photos: %d. Bars missed: %zu.\n", static_cast<int>(groups), missed.size());
  for (const std::string& sentence : missed) std::printf("- %s\n", sentence.c_str());
  return missed.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("The whole way on many kinds of photo: errors, broken values, faces missed");
  std::string data;
  int every = 1;
  app.add_option("--data", data, "data folder (docs/data.md)")->required();
  app.add_option("--every", every, "use every n-th photo only")->capture_default_str()->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    return run(data, every);
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
