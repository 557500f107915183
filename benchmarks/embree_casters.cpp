#include "embree_casters.hpp"

#include <algorithm>

namespace umbrage::benchmarks {

void addCasters(RTCDevice device, RTCScene tree, const scene::Surfaces& s) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto casting = static_cast<std::size_t>(std::count(s.casts.begin(), s.casts.end(), 1));
  auto* points = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, s.positions.size()));
  auto* corners = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, casting));
  for (const Vec3f& p : s.positions)
    for (int k = 0; k < 3; ++k) *points++ = p[k];
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    if (s.casts[t] != 0) corners = std::copy_n(s.triangles[t].data(), 3, corners);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(tree, geometry);
  rtcReleaseGeometry(geometry);
}

}  // namespace umbrage::benchmarks
