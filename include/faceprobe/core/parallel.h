#pragma once
// Splits a loop over threads so that the result is the same for any number of them: each index is worked on once, by one
// thread, and writes only what belongs to it. Sums across indices are the caller's business: keep one partial per block of
// fixed size and add them in order.
//
//   parallel_for(rows, threads, [&](int first, int last) {
//     for (int row = first; row < last; ++row) out.row(row) = ...;
//   });

#include <functional>

namespace faceprobe {

// Threads to use when an option says 0: the processors this process may run on, at least 1.
int default_thread_count();

// Calls body(first, last) over a partition of [0, count). threads <= 0 means default_thread_count(). An exception thrown by
// the body is rethrown here once every thread has ended.
void parallel_for(int count, int threads, const std::function<void(int first, int last)>& body);

}  // namespace faceprobe
