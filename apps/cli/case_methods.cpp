#include "case_methods.h"

#include "faceprobe/core/error.h"
#include "faceprobe/core/version.h"
#include "faceprobe/io/data_files.h"
#include "faceprobe/io/photo.h"
#include "faceprobe/io/picture_file.h"
#include "faceprobe/pipeline/estimate.h"
#include "run_program.h"

#include <cstdint>
#include <memory>
#include <system_error>
#include <vector>

namespace faceprobe::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kMostHashedBytes = 256LL << 20;

std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words;
  for (std::size_t start = command.find_first_not_of(' '); start != std::string::npos;
       start = command.find_first_not_of(' ', start)) {
    const std::size_t end = std::min(command.find(' ', start), command.size());
    words.push_back(command.substr(start, end - start));
    start = end;
  }
  return words;
}

// In one go from left to right: a folder may well be called {out}.
std::string with_paths(const std::string& word, const eval::CaseRunPaths& paths) {
  std::string text;
  for (std::size_t i = 0; i < word.size();) {
    if (word.compare(i, 6, "{case}") == 0) {
      text += paths.data.string();
      i += 6;
    } else if (word.compare(i, 5, "{out}") == 0) {
      text += paths.out.string();
      i += 5;
    } else {
      text += word[i++];
    }
  }
  return text;
}

std::string write_estimate(const pipeline::Estimator& estimator, const eval::CaseRunPaths& paths) {
  try {
    const io::Photo photo = io::load_photo(paths.data / "photo.png");
    const pipeline::Estimate estimate = estimator.estimate(photo);
    io::write_env_map(paths.out / "map.exr", estimate.largest_face().environment);
    io::write_picture(paths.out / "highlight.exr", estimator.separate(photo).highlight);
    return {};
  } catch (const Error& error) {
    if (error.code() != ExitCode::kNoFace) throw;
    return "no face found";
  }
}

}  // namespace

std::string identity_of_file(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored) ||
      fs::file_size(file, ignored) > static_cast<std::uintmax_t>(kMostHashedBytes))
    return {};
  return file.string() + ' ' + io::sha256_of_file(file, kMostHashedBytes) + '\n';
}

// The executable too, because a version is many builds while it is made.
std::string program_identity() {
  return "faceprobe " + std::string(kVersion) + '\n' + identity_of_file("/proc/self/exe");
}

eval::CaseMethod program_method(const std::string& named, int limit_s) {
  const std::size_t equals = named.find('=');
  const auto refuse = [&](const std::string& what) {
    throw Error(ExitCode::kUsage,
                "--method " + named + " " + what + "; it looks like --method \"mine=python3 mine.py {case} {out}\".");
  };
  if (equals == 0 || equals == std::string::npos) refuse("has no name before a =");
  const std::string command = named.substr(equals + 1);
  for (const char* place : {"{case}", "{out}"}) {
    if (command.find(place) == std::string::npos) refuse(std::string("has no ") + place + " in its command");
  }
  const std::vector<std::string> words = words_of(command);
  std::string identity = "program\n";
  for (const std::string& word : words) identity += word + '\n';
  for (const std::string& word : words) identity += identity_of_file(word);
  return {named.substr(0, equals), identity, [words, limit_s](const eval::CaseRunPaths& paths) {
            std::vector<std::string> filled;
            filled.reserve(words.size());
            for (const std::string& word : words) filled.push_back(with_paths(word, paths));
            return run_program(filled, paths.log, limit_s);
          }};
}

eval::CaseMethod own_method(const OwnMethod& own) {
  pipeline::EstimateOptions options;
  options.weights = own.weights;
  options.prior_weights = own.prior;
  options.finder.min_face_px = face::kSmallFacePx;
  options.threads = own.threads;
  std::string identity = program_identity();
  for (const fs::path& file : {own.weights.empty() ? io::find_data("face.safetensors") : own.weights,
                               own.prior.empty() ? io::find_data("light.safetensors") : own.prior})
    identity += identity_of_file(file);
  const auto estimator = std::make_shared<std::unique_ptr<pipeline::Estimator>>();
  return {own.name, identity, [options, estimator](const eval::CaseRunPaths& paths) {
            if (!*estimator) *estimator = std::make_unique<pipeline::Estimator>(options);
            return write_estimate(**estimator, paths);
          }};
}

}  // namespace faceprobe::cli
