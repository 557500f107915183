#include "umbrage/trace/tiles.hpp"

#include <algorithm>

#include "umbrage/parallel/for_each.hpp"

namespace umbrage::trace {
namespace {

constexpr int kTileWidth = 32, kTileHeight = 16;

}  // namespace

Result<void> forEachTile(int width, int height, const std::function<void(const Tile&)>& work) {
  const int columns = (width + kTileWidth - 1) / kTileWidth, rows = (height + kTileHeight - 1) / kTileHeight;
  return parallel::forEach(columns * rows, [&](int i) {
    const int x = i % columns * kTileWidth, y = i / columns * kTileHeight;
    work({x, y, std::min(width, x + kTileWidth), std::min(height, y + kTileHeight)});
  });
}

}  // namespace umbrage::trace
