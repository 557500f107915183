#include "umbrage/io/reader/map_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "umbrage/geo/projection.hpp"

namespace umbrage::io::reader {
namespace {

// A footprint of 0.2 degrees is 20 km wide; one of 10 cm is no building.
constexpr double kLargestDegrees = 0.2;
constexpr double kSmallestMetres = 0.1;
// A cell of a hundredth of a degree is a kilometre wide; one of a centimetre is as fine as any survey.
constexpr double kSmallestCell = 0.01;
// Beyond this from the middle the local projection stretches lengths by more than 1e-4.
constexpr double kLocalReach = 90e3;
constexpr double kEarthRadius = 6371e3;
constexpr Vec2 kNowhere(std::numeric_limits<double>::quiet_NaN());

Extent extentOf(std::span<const Vec2> points) {
  Extent extent;
  for (const Vec2& p : points) extent.add(p);
  return extent;
}

bool fitsDegrees(const Extent& extent) {
  return extent.min.x >= -360.0 && extent.max.x <= 360.0 && extent.min.y >= -90.0 && extent.max.y <= 90.0;
}

std::optional<Error> doubtDegrees(const Extent& extent, double typicalSize, const MapClaim& claim) {
  constexpr const char* kRemedy =
      "if they are metres, say so: --crs EPSG:CODE, or --crs local for no place in particular";
  if (!fitsDegrees(extent))
    return Error{ErrorCode::input,
                 fmt::format("has coordinates that cannot be degrees ({:.6g}, {:.6g}), as {} says they are; {}",
                             extent.max.x, extent.max.y, claim.from, kRemedy),
                 {}};
  if (typicalSize > kLargestDegrees)
    return Error{
        ErrorCode::input,
        fmt::format("has coordinates that are no likely degrees, as {} says they are: a typical outline would be "
                    "{:.0f} km wide; {}",
                    claim.from, typicalSize * 111.0, kRemedy),
        {}};
  return std::nullopt;
}

std::optional<Error> doubtLengths(const Extent& extent, double typicalSize, double unit, const MapClaim& claim) {
  if (!fitsDegrees(extent) || typicalSize <= 0.0 || typicalSize * unit > kSmallestMetres) return std::nullopt;
  return Error{
      ErrorCode::input,
      fmt::format(
          "has coordinates that look like degrees, though {} says they are lengths{}: a typical outline would be "
          "{:.2g} mm wide; if they are longitude and latitude, say so: --crs EPSG:4326",
          claim.from, claim.crs.empty() ? "" : " (" + claim.crs + ")", typicalSize * unit * 1e3),
      {}};
}

// Longitudes on both sides of the 180th meridian are brought together.
void joinLongitudes(std::span<Vec2> points) {
  const Extent extent = extentOf(points);
  if (extent.max.x - extent.min.x <= 180.0) return;
  for (Vec2& p : points)
    if (p.x < 0.0) p.x += 360.0;
}

// Of another datum, to WGS84. Longitudes beyond 180 stay there, so that the middle lies between the points.
void toWgs84(const geo::Projection& degrees, std::span<Vec2> points) {
  for (Vec2& p : points) {
    const auto place = degrees.toDegrees(p);
    p = place ? Vec2(place->longitude + (p.x > 180.0 && place->longitude < 0.0 ? 360.0 : 0.0), place->latitude)
              : kNowhere;
  }
}

Result<MapFrame> projectDegrees(std::span<Vec2> points) {
  const Extent extent = extentOf(points);
  Vec2 middle = 0.5 * (extent.min + extent.max);
  if (middle.x > 180.0) middle.x -= 360.0;
  MapFrame frame{geo::localCrs({middle.x, middle.y}), 1.0, {}};
  const auto local = geo::Projection::make(frame.crs);
  if (!local) return tl::unexpected(local.error());
  double farthest = 0.0;
  for (Vec2& p : points) {
    p = local->fromDegrees({p.x > 180.0 ? p.x - 360.0 : p.x, p.y}).value_or(kNowhere);
    if (std::isfinite(p.x)) farthest = std::max(farthest, std::abs(p.x));
  }
  if (farthest > kLocalReach)
    frame.warning = fmt::format("reaches {:.0f} km from its middle: lengths at its edges are stretched by up to {:.1e}",
                                farthest / 1e3, 0.5 * farthest * farthest / (kEarthRadius * kEarthRadius));
  return frame;
}

}  // namespace

Result<MapFrame> placeOnMap(const MapClaim& claim, std::span<Vec2> points, double typicalSize) {
  const Extent extent = extentOf(points);
  if (claim.crs.empty()) {
    if (const auto doubt = doubtLengths(extent, typicalSize, 1.0, claim)) return tl::unexpected(*doubt);
    return MapFrame{};
  }
  // Longitude and latitude on WGS84 need none of PROJ's data.
  if (claim.crs == "OGC:CRS84" || claim.crs == "EPSG:4326" || claim.crs == "EPSG:4979") {
    if (const auto doubt = doubtDegrees(extent, typicalSize, claim)) return tl::unexpected(*doubt);
    joinLongitudes(points);
    return projectDegrees(points);
  }
  const auto projection = geo::Projection::make(claim.crs);
  if (!projection) {
    Error error = projection.error();
    error.message += "; --crs EPSG:CODE says another, --crs local takes the coordinates as metres";
    return tl::unexpected(error);
  }
  if (!projection->isGeographic()) {
    const double unit = projection->metresPerUnit();
    if (const auto doubt = doubtLengths(extent, typicalSize, unit, claim)) return tl::unexpected(*doubt);
    return MapFrame{claim.crs, unit, {}};
  }
  if (const auto doubt = doubtDegrees(extent, typicalSize, claim)) return tl::unexpected(*doubt);
  joinLongitudes(points);
  toWgs84(*projection, points);
  return projectDegrees(points);
}

Result<void> checkCells(const MapClaim& claim, const MapFrame& frame, const Extent& extent, double cell,
                        double relief) {
  const double side = cell * frame.metresPerUnit, width = extent.size() * frame.metresPerUnit;
  if (!fitsDegrees(extent) || side > kSmallestCell || relief <= width) return {};
  return fail(
      ErrorCode::input,
      fmt::format("has coordinates that look like degrees, though {} says nothing of the kind{}: its cells would "
                  "be {:.2g} mm wide, all of it {:.2g} m, beside heights that differ by {:.2g} m; if they are "
                  "longitude and latitude, say so: --crs EPSG:4326; if not: --crs local",
                  claim.from, claim.crs.empty() ? "" : " (" + claim.crs + ")", side * 1e3, width, relief));
}

Result<void> checkLengths(const scene::Scene& scene, const std::string& metric) {
  MapClaim claim{scene.crs, "its reference system"};
  double unit = 1.0;
  if (scene.crs.empty()) {
    if (metric.empty()) return {};
    claim.from = metric;
  } else {
    const auto projection = geo::Projection::make(scene.crs);
    if (!projection) return {};  // a name for people, not a reference system
    if (projection->isGeographic())
      return fail(
          ErrorCode::unsupported,
          fmt::format(
              "has coordinates in degrees ({}), which are no lengths; convert it to a map's metres, or say what "
              "they are with --crs",
              scene.crs));
    unit = projection->metresPerUnit();
  }
  Extent whole;
  double largest = 0.0;
  for (const scene::Instance& instance : scene.instances) {
    Extent extent;
    for (const Vec3& p : scene.meshes[instance.mesh]->positions) extent.add(Vec2(transformPoint(instance.toWorld, p)));
    if (extent.empty()) continue;
    whole.add(extent.min);
    whole.add(extent.max);
    largest = std::max(largest, extent.size());
  }
  if (const auto doubt = doubtLengths(whole, largest, unit, claim)) return tl::unexpected(*doubt);
  return {};
}

}  // namespace umbrage::io::reader
