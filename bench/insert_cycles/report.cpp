#include "insert_cycles/report.h"

#include "cycles/run_blender.h"
#include "faceprobe/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace faceprobe::bench {

namespace {

constexpr double kErrorTarget = 0.02;
constexpr double kTimeTarget = 1;

const char* verdict(bool met) { return met ? "met" : "missed"; }

std::string joined(const std::vector<int>& numbers) {
  std::string out;
  for (const int number : numbers) out += (out.empty() ? "" : ", ") + std::to_string(number);
  return out;
}

}  // namespace

void print_same_picture(const std::vector<Case>& cases, const InsertOptions& options) {
  std::printf(
      "Blender %s, %d px, %d samples in Cycles and %d here, no adaptive sampling, no denoising, 12 surfaces along a "
      "path.\n"
      "%s on a grey card; the same triangles, normals, materials and maps (256 x 128, bilinear) in both.\n\n"
      "The same picture: RMSE in %% of the picture's mean, over the pixels that show anything; it holds the noise of "
      "both, which\n"
      "two halves with seeds of their own tell. Beyond noise: the root of the mean product of the halves' differences, "
      "in which\n"
      "noise cancels.\n\n"
      "| material | map | RMSE | noise here | noise of Cycles | beyond noise |\n|---|---|---:|---:|---:|---:|\n",
      blender_version(options.blender).c_str(), options.size_px, options.cycles_samples, options.our_samples,
      options.object.empty() ? "A pot" : options.object.stem().string().c_str());
  double worst = 0;
  double worst_beyond = 0;
  for (const Case& one : cases) {
    std::printf("| %s | %s | %.2f | %.2f | %.2f | %.2f |\n", one.material.c_str(), one.map.c_str(), 100 * one.error,
                100 * one.ours.noise, 100 * one.cycles.noise, 100 * one.beyond_noise);
    worst = std::max(worst, one.error);
    worst_beyond = std::max(worst_beyond, one.beyond_noise);
  }
  std::printf("\nWorst: %.2f %% with noise (target 2: %s), %.2f %% beyond noise (target 2: %s)\n", 100 * worst,
              verdict(worst <= kErrorTarget), 100 * worst_beyond, verdict(worst_beyond <= kErrorTarget));
}

void print_time(const std::vector<Case>& cases, const InsertOptions& options) {
  std::printf(
      "\nTime to equal error, %d threads each, in one run. Plain RMSE, bright specks and all, of each renderer at %s "
      "samples\n"
      "against its own converged picture, which has other seeds and whose noise is taken off, in %% of the mean. "
      "Seconds: with\n"
      "the ray-tracing structure built, without start-up and files. error = c t^-p is fitted to them; the last columns "
      "are at the\n"
      "geometric middle of the errors that both reach. CPU ratio: the same of the CPU seconds of all threads, which "
      "other work\n"
      "on the machine hardly changes; ours has the building in it, Cycles' has not.\n\n"
      "| material | map | errors here | seconds here | errors of Cycles | its seconds | at error | here, s | Cycles, s "
      "| ratio "
      "| CPU ratio |\n|---|---|---|---|---|---|---:|---:|---:|---:|---:|\n",
      options.threads, joined(options.timed_samples).c_str());
  double log_sum = 0;
  double log_cpu = 0;
  double worst = 0;
  for (const Case& one : cases) {
    std::printf("| %s | %s |", one.material.c_str(), one.map.c_str());
    for (const Record* record : {&one.ours, &one.cycles}) {
      for (const TimedError& point : record->timed) std::printf(" %.2f", 100 * point.error);
      std::printf(" |");
      for (const TimedError& point : record->timed) std::printf(" %.2f", point.seconds);
      std::printf(" |");
    }
    const double error = common_error(one.ours.timed, one.cycles.timed);
    const double ours = fit(one.ours.timed).seconds_to(error);
    const double cycles = fit(one.cycles.timed).seconds_to(error);
    const double cpu = fit(one.ours.by_cpu).seconds_to(error) / fit(one.cycles.by_cpu).seconds_to(error);
    std::printf(" %.2f | %.2f | %.2f | %.2f | %.2f |\n", 100 * error, ours, cycles, ours / cycles, cpu);
    log_sum += std::log(ours / cycles);
    log_cpu += std::log(cpu);
    worst = std::max(worst, ours / cycles);
  }
  const double mean = std::exp(log_sum / static_cast<double>(cases.size()));
  const double mean_cpu = std::exp(log_cpu / static_cast<double>(cases.size()));
  if (!std::isfinite(mean)) throw Error(ExitCode::kUnexpected, "Too few samples: the errors do not fall with time.");
  std::printf("\nOur time over Cycles': geometric mean %.2f (target 1: %s), worst %.2f; of CPU seconds, mean %.2f\n",
              mean, verdict(mean <= kTimeTarget), worst, mean_cpu);
}

}  // namespace faceprobe::bench
