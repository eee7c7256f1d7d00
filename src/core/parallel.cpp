#include "faceprobe/core/parallel.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

#include <sched.h>

namespace faceprobe {

int default_thread_count() {
  // hardware_concurrency() counts the machine; a container or taskset may allow fewer.
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int, int)>& body) {
  if (count <= 0) return;
  const int workers = std::min(count, threads > 0 ? threads : default_thread_count());
  if (workers == 1) {
    body(0, count);
    return;
  }
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(workers));
  const auto run = [&](int worker) {
    const auto bound = [&](int w) { return static_cast<int>(static_cast<long long>(count) * w / workers); };
    try {
      body(bound(worker), bound(worker + 1));
    } catch (...) {
      failures[static_cast<std::size_t>(worker)] = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  for (int worker = 1; worker < workers; ++worker) others.emplace_back(run, worker);
  run(0);
  others.clear();  // joins
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace faceprobe
