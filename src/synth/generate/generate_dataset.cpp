#include "faceprobe/core/error.h"
#include "faceprobe/core/parallel.h"
#include "faceprobe/synth/generate.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

namespace faceprobe::synth {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Leaves `count` samples in the person's views; a view without samples goes too.
void keep_first(std::vector<ViewSamples>& views, int count) {
  for (ViewSamples& view : views) {
    const int kept = std::clamp(count, 0, static_cast<int>(view.samples.size()));
    view.samples.resize(static_cast<std::size_t>(kept));
    count -= kept;
  }
  std::erase_if(views, [](const ViewSamples& view) { return view.samples.empty(); });
}

int samples_of(const Recipe& recipe, int shard) {
  return std::min(recipe.samples_per_person(), recipe.count - shard * recipe.samples_per_person());
}

void refuse_unusable(const Assets& assets, const Recipe& recipe) {
  if (const std::string problem = recipe.validate(); !problem.empty()) throw Error(ExitCode::kUsage, problem);
  if (assets.heads.empty()) throw Error(ExitCode::kUsage, "No head model was given; name at least one.");
  if (assets.maps.empty()) throw Error(ExitCode::kUsage, "No environment map was given; name at least one.");
  for (const HeadModel& model : assets.heads) {
    if (const std::string problem = model.validate(); !problem.empty()) {
      throw Error(ExitCode::kInput, "Head model " + model.name + ": " + problem);
    }
  }
}

}  // namespace

DatasetReport generate_dataset(const Assets& assets, const Recipe& recipe, const std::filesystem::path& folder,
                               const RunOptions& options, const std::function<void(const RunState&)>& progress) {
  refuse_unusable(assets, recipe);
  const ShardWriter writer(
      folder,
      {.size_px = recipe.size_px, .environment_height = recipe.environment_height, .recipe = recipe_of(assets, recipe)});
  const auto start = std::chrono::steady_clock::now();
  DatasetReport report;
  report.state.samples_total = recipe.count;
  std::vector<int> missing;
  for (int shard = 0; shard < recipe.person_count(); ++shard) {
    if (writer.has(shard)) {
      report.state.samples_found += samples_of(recipe, shard);
    } else {
      missing.push_back(shard);
    }
  }
  report.state.samples_done = report.state.samples_found;
  if (progress) progress(report.state);

  const int threads = options.threads > 0 ? options.threads : default_thread_count();
  // Threads that would find no person of their own help with one.
  const int threads_each = std::max(1, threads / std::max(1, static_cast<int>(missing.size())));
  // People differ in cost, so each worker takes the next one when it is free; no result depends on who takes which.
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // guards report, failure and progress
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      while (true) {
        const std::size_t at = next++;
        if (at >= missing.size()) return;
        const int shard = missing[at];
        GenerateTimes times;
        std::vector<ViewSamples> views = generate_person(assets, recipe, shard, threads_each, &times);
        keep_first(views, samples_of(recipe, shard));
        const auto write_start = std::chrono::steady_clock::now();
        writer.write(shard, views);
        times.write += seconds_since(write_start);
        const std::scoped_lock lock(mutex);
        if (failure) return;
        report.times += times;
        report.state.samples_done += samples_of(recipe, shard);
        report.state.seconds = seconds_since(start);
        if (progress) progress(report.state);
      }
    } catch (...) {
      next = missing.size();
      const std::scoped_lock lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    const auto count = std::min(static_cast<std::size_t>(threads), missing.size());
    for (std::size_t i = 1; i < count; ++i) workers.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  writer.finish(recipe.person_count(), data_card(assets, recipe));
  report.state.seconds = seconds_since(start);
  return report;
}

}  // namespace faceprobe::synth
