#include "umbrage/io/reader/geos_triangulation.hpp"

#include <map>
#include <optional>
#include <utility>

#include "umbrage/io/reader/geos_handles.hpp"

namespace umbrage::io::reader {
namespace {

using Place = std::pair<double, double>;
using IndexOf = std::map<Place, std::uint32_t>;

GEOSGeometry* makeRing(GEOSContextHandle_t context, const std::vector<PlaneCorner>& ring) {
  const auto size = static_cast<unsigned>(ring.size());
  GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(context, size + 1, 2);
  for (unsigned i = 0; i <= size; ++i)
    GEOSCoordSeq_setXY_r(context, sequence, i, ring[i % size].at.x, ring[i % size].at.y);
  return GEOSGeom_createLinearRing_r(context, sequence);
}

GeosGeometry makePolygon(GEOSContextHandle_t context, const PlanePolygon& polygon) {
  std::vector<GEOSGeometry*> holes;
  for (std::size_t i = 1; i < polygon.size(); ++i) holes.push_back(makeRing(context, polygon[i]));
  GEOSGeometry* made = GEOSGeom_createPolygon_r(context, makeRing(context, polygon.front()), holes.data(),
                                                static_cast<unsigned>(holes.size()));
  return {made, DestroyGeometry{context}};
}

// Nothing when two corners with different indices fall on one place: GEOS could not tell them apart.
std::optional<IndexOf> indexCorners(const PlanePolygon& polygon) {
  IndexOf indexOf;
  for (const auto& ring : polygon)
    for (const PlaneCorner& corner : ring)
      if (const auto [at, isNew] = indexOf.try_emplace({corner.at.x, corner.at.y}, corner.index);
          !isNew && at->second != corner.index)
        return std::nullopt;
  return indexOf;
}

std::optional<mesh::Triangle> cornersOf(GEOSContextHandle_t context, const GEOSGeometry* triangle,
                                        const IndexOf& indexOf) {
  const GEOSGeometry* ring = GEOSGetExteriorRing_r(context, triangle);
  const GEOSCoordSequence* sequence = ring != nullptr ? GEOSGeom_getCoordSeq_r(context, ring) : nullptr;
  unsigned size = 0;
  if (sequence == nullptr || GEOSCoordSeq_getSize_r(context, sequence, &size) == 0 || size != 4) return std::nullopt;
  Vec2 at[3];
  mesh::Triangle corners{};
  for (unsigned k = 0; k < 3; ++k) {
    GEOSCoordSeq_getXY_r(context, sequence, k, &at[k].x, &at[k].y);
    const auto found = indexOf.find({at[k].x, at[k].y});
    if (found == indexOf.end()) return std::nullopt;
    corners[k] = found->second;
  }
  const double area = turn(at[0], at[1], at[2]);
  if (area == 0.0) return std::nullopt;
  if (area < 0.0) std::swap(corners[1], corners[2]);
  return corners;
}

}  // namespace

std::vector<mesh::Triangle> triangulateWithGeos(const PlanePolygon& polygon) {
  const auto indexOf = indexCorners(polygon);
  if (!indexOf) return {};
  // Without handlers GEOS keeps its complaints to itself; the result says enough.
  const GeosContext context(GEOS_init_r());
  const GeosGeometry whole = makePolygon(context.get(), polygon);
  if (whole == nullptr) return {};
  const GeosGeometry parts(GEOSConstrainedDelaunayTriangulation_r(context.get(), whole.get()),
                           DestroyGeometry{context.get()});
  if (parts == nullptr) return {};
  std::vector<mesh::Triangle> triangles;
  const int count = GEOSGetNumGeometries_r(context.get(), parts.get());
  for (int i = 0; i < count; ++i) {
    const auto corners = cornersOf(context.get(), GEOSGetGeometryN_r(context.get(), parts.get(), i), *indexOf);
    if (!corners) return {};
    triangles.push_back(*corners);
  }
  return triangles;
}

}  // namespace umbrage::io::reader
