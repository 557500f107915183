#pragma once

#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// Which half of the sums a sample of a light goes into: by itself each half fills the light as evenly.
[[nodiscard]] constexpr std::size_t halfOf(std::size_t sample) { return sample / 8 % 2; }

/// What is known of a light from its sums (GpuFrame::maskSum) after so many samples. `ids`: the triangles that are seen.
[[nodiscard]] shadow::SoftStats softStats(const image::Image<Vec4f>& sums, const image::Image<std::uint32_t>& ids,
                                          std::size_t samples);

}  // namespace umbrage::render
