#include "net/thread_count.h"

#include "faceprobe/core/parallel.h"

// Of the OpenMP runtime that oneDNN brings. Declared here because clang has no omp.h without a runtime of its own.
extern "C" int omp_get_max_threads();
extern "C" void omp_set_num_threads(int);

namespace faceprobe::net {

ThreadCount::ThreadCount(int threads) : before_(omp_get_max_threads()) {
  omp_set_num_threads(threads > 0 ? threads : default_thread_count());
}
ThreadCount::~ThreadCount() { omp_set_num_threads(before_); }

}  // namespace faceprobe::net
