#pragma once

#include <embree3/rtcore.h>

#include "umbrage/scene/surfaces.hpp"

namespace umbrage::benchmarks {

/// The casting triangles of `surfaces` as one geometry of a scene of Embree's that is not committed yet.
void addCasters(RTCDevice device, RTCScene tree, const scene::Surfaces& surfaces);

}  // namespace umbrage::benchmarks
