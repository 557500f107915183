#include "umbrage/trace/tiles.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace umbrage::trace {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;

using Range = tbb::blocked_range<int>;

#ifdef __SANITIZE_THREAD__
// The thread sanitizer cannot see how the threads of a TBB without instrumentation wait for each other; of plain threads it can.
void inThreads(const Range& all, const std::function<void(const Range&)>& work) {
  std::atomic<int> next = all.begin();
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      for (int i = next++; i < all.end(); i = next++) work(Range(i, i + 1));
    });
}
#else
void inThreads(const Range& all, const std::function<void(const Range&)>& work) { tbb::parallel_for(all, work); }
#endif

}  // namespace

Result<void> forEachTile(int width, int height, const std::function<void(const Tile&)>& work) {
  const int columns = (width + kTileWidth - 1) / kTileWidth, rows = (height + kTileHeight - 1) / kTileHeight;
  try {
    inThreads(Range(0, columns * rows), [&](const Range& range) {
      for (int i = range.begin(); i < range.end(); ++i) {
        const int x = i % columns * kTileWidth, y = i / columns * kTileHeight;
        work({x, y, std::min(width, x + kTileWidth), std::min(height, y + kTileHeight)});
      }
    });
  } catch (const std::exception& e) {
    return fail(ErrorCode::device, std::string("ray tracing in threads failed: ") + e.what());
  }
  return {};
}

}  // namespace umbrage::trace
