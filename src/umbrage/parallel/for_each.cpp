#include "umbrage/parallel/for_each.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <exception>
#include <string>
#include <thread>
#include <vector>

namespace umbrage::parallel {
namespace {

#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot see how the threads of a TBB without instrumentation wait for each other; of plain threads it can.
void inThreads(int count, const std::function<void(int)>& work) {
  std::atomic<int> next = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = next++; i < count; i = next++) work(i);
    });
}
#else
// A pool of threads that waits for no thread that has nothing to do: on a busy machine a fresh one may come too late to help.
void inThreads(int count, const std::function<void(int)>& work) {
  using Range = tbb::blocked_range<int>;
  tbb::parallel_for(
      Range(0, count, 1),
      [&](const Range& range) {
        for (int i = range.begin(); i < range.end(); ++i) work(i);
      },
      tbb::simple_partitioner());
}
#endif

}  // namespace

Result<void> forEach(int count, const std::function<void(int)>& work) {
  try {
    inThreads(count, work);
  } catch (const std::exception& e) {
    return fail(ErrorCode::device, std::string("work in threads failed: ") + e.what());
  }
  return {};
}

}  // namespace umbrage::parallel
