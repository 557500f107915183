#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

#include "umbrage/base/progress.hpp"

namespace umbrage::outline::detail {

/// Calls work(i) for 0 <= i < count from as many threads as there are cores, in no order. False when the sink asked to stop; what
/// had begun was finished.
template <class Work>
bool inParallel(std::size_t count, const Work& work, const ProgressSink& progress = {}, const char* what = "") {
  const std::size_t threads = std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), count);
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> stop{false};
  const auto run = [&](bool tells) {
    for (std::size_t i = next++; i < count && !stop; i = next++) {
      work(i);
      const std::size_t finished = ++done;
      if (tells && !reportProgress(progress, double(finished) / double(count), what)) stop = true;
    }
  };
  std::vector<std::jthread> workers;
  for (std::size_t t = 1; t < threads; ++t) workers.emplace_back(run, false);
  run(true);
  workers.clear();
  return !stop;
}

}  // namespace umbrage::outline::detail
