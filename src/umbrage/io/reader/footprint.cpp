#include "umbrage/io/reader/footprint.hpp"

#include <algorithm>

#include "umbrage/io/reader/geos_handles.hpp"
#include "umbrage/io/reader/polygon.hpp"

namespace umbrage::io::reader {
namespace {

using Ring = std::vector<Vec2>;

GEOSGeometry* geosRing(GEOSContextHandle_t context, const Ring& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* points = GEOSCoordSeq_create_r(context, size + 1, 2);
  for (unsigned i = 0; i <= size; ++i) GEOSCoordSeq_setXY_r(context, points, i, ring[i % size].x, ring[i % size].y);
  return GEOSGeom_createLinearRing_r(context, points);
}

GeosGeometry geosPolygon(GEOSContextHandle_t context, const Footprint& footprint) {
  std::vector<GEOSGeometry*> holes;
  for (std::size_t i = 1; i < footprint.size(); ++i) holes.push_back(geosRing(context, footprint[i]));
  return {GEOSGeom_createPolygon_r(context, geosRing(context, footprint.front()), holes.data(),
                                   static_cast<unsigned>(holes.size())),
          DestroyGeometry{context}};
}

Ring ringOf(GEOSContextHandle_t context, const GEOSGeometry* ring) {
  Ring points;
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context, ring);
  unsigned size = 0;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(context, sequence, &size) == 0) return points;
  for (unsigned i = 0; i + 1 < size; ++i) {
    Vec2 p(0.0);
    GEOSCoordSeq_getXY_r(context, sequence, i, &p.x, &p.y);
    points.push_back(p);
  }
  return points;
}

void collectPolygons(GEOSContextHandle_t context, const GEOSGeometry* geometry, std::vector<Footprint>& footprints) {
  const int type = GEOSGeomTypeId_r(context, geometry);
  if (type == GEOS_POLYGON) {
    Footprint footprint;
    footprint.push_back(ringOf(context, GEOSGetExteriorRing_r(context, geometry)));
    for (int i = 0; i < GEOSGetNumInteriorRings_r(context, geometry); ++i)
      footprint.push_back(ringOf(context, GEOSGetInteriorRingN_r(context, geometry, i)));
    if (footprint = cleanFootprint(footprint); !footprint.empty()) footprints.push_back(std::move(footprint));
  } else if (type == GEOS_MULTIPOLYGON || type == GEOS_GEOMETRYCOLLECTION) {
    for (int i = 0; i < GEOSGetNumGeometries_r(context, geometry); ++i)
      collectPolygons(context, GEOSGetGeometryN_r(context, geometry, i), footprints);
  }
}

double doubleArea(const Ring& ring) {
  double area = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    area += a.x * b.y - a.y * b.x;
  }
  return area;
}

// Outer rings counter-clockwise, holes clockwise: then every wall winds outwards.
Footprint oriented(Footprint footprint) {
  for (std::size_t i = 0; i < footprint.size(); ++i)
    if ((doubleArea(footprint[i]) > 0.0) != (i == 0)) std::reverse(footprint[i].begin(), footprint[i].end());
  return footprint;
}

}  // namespace

Footprint cleanFootprint(const Footprint& footprint) {
  Footprint cleaned;
  for (const Ring& ring : footprint) {
    Ring kept;
    for (const Vec2& p : ring)
      if (kept.empty() || kept.back() != p) kept.push_back(p);
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() >= 3)
      cleaned.push_back(std::move(kept));
    else if (cleaned.empty())
      return {};
  }
  return cleaned;
}

bool isSimple(const Footprint& footprint) {
  const GeosContext context(GEOS_init_r());
  const GeosGeometry polygon = geosPolygon(context.get(), footprint);
  return polygon && GEOSisValid_r(context.get(), polygon.get()) == 1;
}

// Ring by ring: mended together, what of a hole lies outside the outer ring would become a building.
std::vector<Footprint> untangle(const Footprint& footprint) {
  const GeosContext context(GEOS_init_r());
  const DestroyGeometry destroy{context.get()};
  const auto area = [&](const Ring& ring) {
    const GeosGeometry polygon = geosPolygon(context.get(), {ring});
    GeosGeometry valid(polygon ? GEOSMakeValid_r(context.get(), polygon.get()) : nullptr, destroy);
    // Areas with spikes, of which there can be no difference: a buffer of nothing leaves the areas.
    if (valid && GEOSGeomTypeId_r(context.get(), valid.get()) == GEOS_GEOMETRYCOLLECTION)
      valid = GeosGeometry(GEOSBuffer_r(context.get(), valid.get(), 0.0, 8), destroy);
    return valid;
  };
  GeosGeometry whole = area(footprint.front());
  for (std::size_t i = 1; i < footprint.size() && whole; ++i)
    if (const GeosGeometry hole = area(footprint[i]))
      whole = GeosGeometry(GEOSDifference_r(context.get(), whole.get(), hole.get()), destroy);
  std::vector<Footprint> footprints;
  if (whole) collectPolygons(context.get(), whole.get(), footprints);
  return footprints;
}

void addPrism(mesh::Mesh& mesh, const Footprint& given, double base, double top) {
  const Footprint footprint = oriented(given);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  Rings rings;
  std::uint32_t count = 0;
  for (const Ring& ring : footprint) {
    auto& corners = rings.emplace_back();
    for (std::size_t i = 0; i < ring.size(); ++i) corners.push_back(first + count++);
  }
  for (const double height : {base, top})
    for (const Ring& ring : footprint)
      for (const Vec2& p : ring) mesh.positions.emplace_back(p, height);
  for (const mesh::Triangle& t : triangulate(mesh.positions, rings)) {
    mesh.triangles.push_back({t[2], t[1], t[0]});
    mesh.triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  }
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      mesh.triangles.push_back({a, b, b + count});
      mesh.triangles.push_back({a, b + count, a + count});
    }
}

}  // namespace umbrage::io::reader
