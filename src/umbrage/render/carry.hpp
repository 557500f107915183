#pragma once

#include "umbrage/render/prepare_light.hpp"

namespace umbrage::render {

/// Carries the vertices of a light's volumes away from the light on the processor: fills LightVolume::points with those that the volumes use, each once,
/// relative to the eye, and points the indices at them.
/// 1. The points are, bit by bit, what the vertex shaders volume.vert and volume_far.vert compute.
void carryOnProcessor(const shadow::CasterSet& casters, const Vec3& eye, LightVolume& volume);

}  // namespace umbrage::render
