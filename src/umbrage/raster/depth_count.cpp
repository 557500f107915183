#include "umbrage/raster/depth_count.hpp"

namespace umbrage::raster {

void DepthCount::open(const ActivePatch& side, int y) {
  open_.push_back({side.covered, side.patch->weight, alongRow(*side.patch, 3, y), side.patch->distance});
}

void DepthCount::change(const Run& run, int y) {
  const Slope surface = alongRow(*run.surface, 3, y);
  for (const Open& side : open_) {
    const Slope before{side.plane.at0 - surface.at0 * side.distance,
                       side.plane.perPixel - surface.perPixel * side.distance};
    const Stretch pixels = above(before, 0.0, meet(side.covered, run.pixels));
    if (pixels.empty()) continue;
    change_[static_cast<std::size_t>(pixels.begin)] += side.weight;
    change_[static_cast<std::size_t>(pixels.end)] -= side.weight;
  }
}

}  // namespace umbrage::raster
