#include "umbrage/radiosity/seen_light.hpp"

#include <algorithm>

#include "umbrage/parallel/for_each.hpp"
#include "umbrage/radiosity/detail/patches.hpp"
#include "umbrage/radiosity/direct_light.hpp"
#include "umbrage/radiosity/visible_factor.hpp"
#include "umbrage/shadow/barycentric.hpp"

namespace umbrage::radiosity {
namespace {

constexpr std::size_t kPointsPerBlock = 64;

// The parts of vertices from the first on that has none yet.
Result<void> look(const trace::Occlusion& occlusion, const DirectLight& light, SeenLight& seen) {
  const std::size_t first = seen.parts.size(), count = seen.mesh.vertices().size();
  seen.mesh.placeSamples(first, [&](const Vertex& v) { return 4.0 * liftOf(occlusion, v.triangle, v.position); });
  seen.parts.resize(count);
  return parallel::forEach(static_cast<int>((count - first + kPointsPerBlock - 1) / kPointsPerBlock), [&](int block) {
    const std::size_t begin = first + static_cast<std::size_t>(block) * kPointsPerBlock;
    std::vector<SurfacePoint> points;
    for (std::size_t v = begin; v < std::min(count, begin + kPointsPerBlock); ++v) {
      const Vertex& vertex = seen.mesh.vertices()[v];
      points.push_back({vertex.sample, seen.mesh.sheets()[vertex.sheet].normal, vertex.triangle});
    }
    std::vector<std::array<double, 2>> parts(points.size());
    light.seen(points, parts);
    for (std::size_t i = 0; i < parts.size(); ++i)
      seen.parts[begin + i] = {static_cast<float>(parts[i][0]), static_cast<float>(parts[i][1])};
  });
}

bool isUneven(const SeenLight& seen, const Element& element, double error) {
  for (std::size_t s = 0; s < 2; ++s) {
    float low = seen.parts[element.centre][s], high = low;
    for (const std::uint32_t corner : element.corner)
      low = std::min(low, seen.parts[corner][s]), high = std::max(high, seen.parts[corner][s]);
    if (high - low > error) return true;
  }
  return false;
}

}  // namespace

double SeenLight::at(std::uint32_t triangle, const Vec3& point, std::size_t side) const {
  const auto place = mesh.find(triangle, shadow::barycentric(mesh.surfaces(), triangle, point));
  if (!place) return 0.0;
  double part = 0.0;
  for (const Share& share : mesh.between(*place)) part += share.part * double(parts[share.vertex][side]);
  return part;
}

Result<SeenLight> seenLight(const trace::Occlusion& occlusion, const scene::Light& light, const SeenOptions& options) {
  const scene::Surfaces& surfaces = occlusion.surfaces();
  SeenLight seen{Subdivision(surfaces), {}};
  const Box3& near = surfaces.casterBounds.empty() ? surfaces.bounds : surfaces.casterBounds;
  const double radius = near.empty() ? 1.0 : near.radius();
  if (auto cut = detail::Patches::cut(seen.mesh, near, options.coarse * radius, false); !cut)
    return tl::unexpected(cut.error());
  Box3 room = surfaces.bounds;
  if (!room.empty()) room.min += surfaces.origin, room.max += surfaces.origin;
  const DirectLight direct(occlusion, light, options.samples, room);
  while (true) {
    if (auto looked = look(occlusion, direct, seen); !looked) return tl::unexpected(looked.error());
    const auto elements = static_cast<std::uint32_t>(seen.mesh.elements().size());
    for (std::uint32_t e = 0; e < elements && seen.mesh.elements().size() < options.mostElements; ++e) {
      const Element& element = seen.mesh.elements()[e];
      const bool large = seen.mesh.longestEdge(element) >= 2.0 * options.fine * radius;
      if (element.children == 0 && large && isUneven(seen, element, options.error)) seen.mesh.split(e);
    }
    if (seen.mesh.elements().size() == elements) return seen;
  }
}

}  // namespace umbrage::radiosity
