#pragma once

#include "umbrage/shadow/surface_buffer.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::render {

/// What is known of a light from its sums (GpuFrame::maskSum) after so many samples. `ids`: the triangles that are seen.
[[nodiscard]] shadow::SoftStats softStats(const image::Image<Vec4f>& sums, const image::Image<std::uint32_t>& ids,
                                          std::size_t samples);

}  // namespace umbrage::render
