#include "umbrage/trace/tiles.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>

namespace umbrage::trace {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;

}  // namespace

Result<void> forEachTile(int width, int height, const std::function<void(const Tile&)>& work) {
  const int columns = (width + kTileWidth - 1) / kTileWidth, rows = (height + kTileHeight - 1) / kTileHeight;
  try {
    tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows), [&](const tbb::blocked_range<int>& range) {
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
