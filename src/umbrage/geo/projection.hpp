#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "umbrage/base/angle.hpp"
#include "umbrage/base/error.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::geo {

/// A point of the Earth's surface on WGS84, in degrees: east and north positive.
struct LonLat {
  double longitude = 0.0;
  double latitude = 0.0;
};

/// Between the coordinates of a coordinate reference system (x east, y north, in its own unit) and WGS84.
/// 1. `toDegrees(fromDegrees(p))` is p within 1e-9 degrees inside the system's area of use.
/// 2. Nothing is fetched from a network; without grid files transformations of datum are right to a few metres.
/// CAVEAT: not to be used by two threads at once.
class Projection {
 public:
  /// "EPSG:28992", "OGC:CRS84" and the like, or a PROJ string ("+proj=tmerc ..."), which needs no data files.
  /// Errors: input, for names that are not known and where PROJ's data (proj.db) are missing; unsupported, for systems
  /// that are neither projected nor geographic.
  [[nodiscard]] static Result<Projection> make(std::string_view crs);

  Projection(Projection&&) noexcept;
  Projection& operator=(Projection&&) noexcept;
  ~Projection();

  /// Its coordinates are degrees (longitude, latitude), not lengths.
  [[nodiscard]] bool isGeographic() const;
  /// Length of one unit; 1 for geographic systems, whose unit is no length.
  [[nodiscard]] double metresPerUnit() const;
  /// Nothing where the system does not reach.
  [[nodiscard]] std::optional<LonLat> toDegrees(const Vec2& xy) const;
  [[nodiscard]] std::optional<Vec2> fromDegrees(const LonLat& place) const;
  /// True north at this point lies so much clockwise of the y axis.
  [[nodiscard]] std::optional<Angle> trueNorth(const Vec2& xy) const;

 private:
  struct State;
  explicit Projection(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A transverse Mercator in metres around a place: x east, y north, (0, 0) at the place, scale 1 on its meridian. Lengths
/// within d of the place are right to (d / 6371 km)^2 / 2: 1.3e-6 at 10 km. Needs no data files.
[[nodiscard]] std::string localCrs(const LonLat& place);

/// The shortest form that Projection::make knows of a name in the wild: "EPSG:28992" for "urn:ogc:def:crs:EPSG::28992" and
/// "https://www.opengis.net/def/crs/EPSG/0/28992"; "OGC:CRS84" for "urn:ogc:def:crs:OGC:1.3:CRS84"; others as they are.
[[nodiscard]] std::string shortName(const std::string& crs);

/// Metres between two places on a sphere of 6371 km.
[[nodiscard]] double distance(const LonLat& a, const LonLat& b);

}  // namespace umbrage::geo
