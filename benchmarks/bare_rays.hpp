#pragma once

#include <memory>

#include "umbrage/shadow/surface_buffer.hpp"
#include "views.hpp"

namespace umbrage::benchmarks {

/// The yardstick for ray_traced: Embree's coherent packets of 4 x 2 pixels from a depth buffer, straight and in single precision:
/// positions from depth, starts lifted along the triangle's normal, one occlusion query a packet, a byte a pixel. The same tree,
/// tiles and threads as trace, without its care for slivers, lights near surfaces, grazing light and distance.
class BareRays {
 public:
  explicit BareRays(const View& view);
  ~BareRays();
  BareRays(const BareRays&) = delete;
  BareRays& operator=(const BareRays&) = delete;

  [[nodiscard]] image::GreyImage mask(const shadow::SurfaceBuffer& seen) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbrage::benchmarks
