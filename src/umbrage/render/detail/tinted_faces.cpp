#include "umbrage/render/detail/tinted_faces.hpp"

#include <bit>

namespace umbrage::render::detail {

std::vector<Face> facesOf(const shadow::Geometry& geometry) {
  const scene::Surfaces& surfaces = geometry.surfaces;
  std::vector<Face> faces;
  faces.reserve(surfaces.triangles.size());
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const Vec3 normal = surfaces.normal(t);
    const double length = glm::length(normal);
    const shadow::FilterSum& filter = geometry.filters.of(t);
    faces.push_back(
        {Vec4f(length > 0.0 ? Vec3f(normal / length) : Vec3f(0.0f), std::bit_cast<float>(surfaces.materials[t])),
         Vec4f(Vec3f(surfaces.corner(t, 0)), 1.0f),
         {filter[0], filter[1], filter[2], geometry.filters.isVeil(t) ? 1 : 0}});
  }
  return faces;
}

std::vector<std::uint32_t> packLightBits(std::span<const std::uint8_t> facing, std::span<const std::int8_t> side) {
  std::vector<std::uint32_t> words((facing.size() + 7) / 8);
  for (std::size_t t = 0; t < facing.size(); ++t) {
    std::uint32_t bits = facing[t] != 0 ? 1 : 0;
    if (!side.empty() && side[t] != 0) bits |= side[t] > 0 ? 2u : 4u;
    words[t / 8] |= bits << (4 * (t % 8));
  }
  return words;
}

}  // namespace umbrage::render::detail
