#include "insert_cycles/comparison.h"

#include "faceprobe/render/path_tracer.h"
#include "insert_cycles/cycles.h"
#include "insert_cycles/maps.h"
#include "insert_cycles/scene.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <utility>

namespace faceprobe::bench {

namespace {

constexpr int kMaxBounces = 12;
constexpr int kTimedSeed = 3;

TimedPicture render_ours(const render::Model& model, const TestMap& map, int samples, int seed,
                         const InsertOptions& options) {
  render::RenderOptions how{.samples = samples, .least_samples = samples, .noise = 0, .max_bounces = kMaxBounces};
  how.seed = static_cast<std::uint64_t>(seed);
  how.threads = options.threads;
  const std::clock_t cpu = std::clock();
  const auto start = std::chrono::steady_clock::now();
  const render::PathTracer tracer(model, map.radiance, {.view = scene_view(options.size_px)});
  TimedPicture out{tracer.render(how).object};
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  return out;
}

struct Wanted {
  int samples;
  int seed;
};
// Two halves of the converged picture, then the timed ones.
std::vector<Wanted> wanted(int converged, const std::vector<int>& timed) {
  std::vector<Wanted> out = {{converged / 2, 1}, {converged / 2, 2}};
  for (const int samples : timed) out.push_back({samples, kTimedSeed});
  return out;
}

// As wanted() orders them.
struct Figures {
  Halves halves;
  Image converged;
  Record record;
};
Figures figures_of(const TimedPicture* done, const InsertOptions& options) {
  Figures out{{done[0].picture, done[1].picture}, mean_of(done[0].picture, done[1].picture), {}};
  out.record.noise = error_over_mean(out.halves.first, out.halves.second, out.converged) / 2;
  for (std::size_t i = 0; i < options.timed_samples.size(); ++i) {
    const TimedPicture& timed = done[2 + i];
    const double error = error_against(timed.picture, out.halves, out.converged);
    out.record.timed.push_back({timed.seconds, error});
    out.record.by_cpu.push_back({timed.cpu_seconds, error});
  }
  return out;
}

}  // namespace

std::vector<Case> compare_material(std::size_t material, const InsertOptions& options) {
  const TestMaterial& finish = test_materials().at(material);
  const render::Model model = stand_on_card(options.object, finish.ours);
  const std::vector<TestMap> maps = test_maps(options.maps, options.map_count);

  std::vector<CyclesShot> shots;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    for (const Wanted& one : wanted(options.cycles_samples, options.timed_samples))
      shots.push_back({m, one.samples, one.seed});
  }
  const CyclesJob job{options.blender, options.folder / finish.name, options.threads, kMaxBounces, options.size_px};
  const std::vector<TimedPicture> theirs = render_with_cycles(job, model, finish, maps, shots);

  std::vector<Case> out;
  for (std::size_t m = 0; m < maps.size(); ++m) {
    std::vector<TimedPicture> ours;
    for (const Wanted& one : wanted(options.our_samples, options.timed_samples))
      ours.push_back(render_ours(model, maps[m], one.samples, one.seed, options));
    Figures here = figures_of(ours.data(), options);
    Figures there = figures_of(theirs.data() + m * ours.size(), options);
    Case one{finish.name, maps[m].name};
    one.error = error_over_mean(here.converged, there.converged, there.converged);
    one.beyond_noise = error_beyond_noise(here.halves, there.halves, there.converged);
    one.ours = std::move(here.record);
    one.cycles = std::move(there.record);
    one.pair = {std::move(here.converged), std::move(there.converged)};
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace faceprobe::bench
