#include "umbrage/geo/projection.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

namespace umbrage::geo {
namespace {

constexpr double kEarthRadius = 6371e3;
// How far the step goes that finds north: 11 m, over which no projection in use bends by a thousandth of a degree.
constexpr double kNorthStep = 1e-4;
constexpr std::size_t kLongestName = 1000;

struct ContextEnd {
  void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct PjEnd {
  void operator()(PJ* object) const { proj_destroy(object); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextEnd>;
using Pj = std::unique_ptr<PJ, PjEnd>;

// What a file may name: an authority's code or a plain projection, nothing that makes PROJ open files of its choosing.
bool isCode(std::string_view crs) {
  const auto colon = crs.find(':');
  const auto plain = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
  };
  return colon != crs.npos && plain(crs.substr(0, colon)) && plain(crs.substr(colon + 1)) && !crs.starts_with("init");
}
bool isPlainProjection(std::string_view crs) {
  if (!crs.starts_with("+proj=") || crs.size() > kLongestName) return false;
  for (const std::string_view word : {"pipeline", "grids", "file", "init", "@", "/"})
    if (crs.find(word) != crs.npos) return false;
  return true;
}

bool isGeographicType(PJ_TYPE type) { return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS; }

// The horizontal part of a compound system, and what a bound one is bound to.
Pj horizontal(PJ_CONTEXT* context, Pj crs) {
  for (;;) {
    const PJ_TYPE type = proj_get_type(crs.get());
    if (type == PJ_TYPE_BOUND_CRS)
      crs = Pj(proj_get_source_crs(context, crs.get()));
    else if (type == PJ_TYPE_COMPOUND_CRS)
      crs = Pj(proj_crs_get_sub_crs(context, crs.get(), 0));
    else
      return crs;
    if (!crs) return crs;
  }
}

double unitOf(PJ_CONTEXT* context, const PJ* crs) {
  const Pj axes(proj_crs_get_coordinate_system(context, crs));
  double factor = 1.0;
  if (axes &&
      proj_cs_get_axis_info(context, axes.get(), 0, nullptr, nullptr, nullptr, &factor, nullptr, nullptr, nullptr))
    return factor;
  return 1.0;
}

tl::unexpected<Error> unknown(PJ_CONTEXT* context, std::string_view crs) {
  if (isCode(crs) && proj_context_get_database_path(context) == nullptr)
    return fail(
        ErrorCode::input,
        fmt::format("names the reference system {}, but PROJ's data (proj.db) are not found; install proj-data or "
                    "set PROJ_DATA to their folder",
                    crs));
  return fail(ErrorCode::input, fmt::format("names a reference system that is not known: '{}'", crs));
}

bool isFinite(const PJ_COORD& c) { return std::isfinite(c.xy.x) && std::isfinite(c.xy.y); }

}  // namespace

struct Projection::State {
  Context context;
  Pj toWgs84;             // forward: coordinates to degrees
  bool inverted = false;  // a bare projection goes from radians to coordinates
  bool geographic = false;
  double unit = 1.0;
};

Projection::Projection(std::unique_ptr<State> state) : state_(std::move(state)) {}
Projection::Projection(Projection&&) noexcept = default;
Projection& Projection::operator=(Projection&&) noexcept = default;
Projection::~Projection() = default;

Result<Projection> Projection::make(std::string_view crs) {
  auto state = std::make_unique<State>();
  state->context = Context(proj_context_create());
  PJ_CONTEXT* context = state->context.get();
  proj_log_func(context, nullptr, [](void*, int, const char*) {});
  proj_context_set_enable_network(context, 0);
  const std::string name(crs);
  if (isPlainProjection(crs) && crs.find("+type=crs") == crs.npos && crs.find("+ellps=WGS84") != crs.npos) {
    state->toWgs84 = Pj(proj_create(context, name.c_str()));
    state->inverted = true;
    if (!state->toWgs84) return unknown(context, crs);
    return Projection(std::move(state));
  }
  if (!isCode(crs) && !isPlainProjection(crs)) return unknown(context, crs);
  Pj system(proj_create(context, isCode(crs) ? name.c_str() : (name + " +type=crs").c_str()));
  if (system) system = horizontal(context, std::move(system));
  if (!system) return unknown(context, crs);
  const PJ_TYPE type = proj_get_type(system.get());
  state->geographic = isGeographicType(type);
  if (!state->geographic && type != PJ_TYPE_PROJECTED_CRS)
    return fail(ErrorCode::unsupported,
                fmt::format("names the reference system {}, which is neither a map nor degrees", crs));
  if (!state->geographic) state->unit = unitOf(context, system.get());
  const Pj wgs84(proj_create(context, "OGC:CRS84"));
  if (!wgs84) return unknown(context, crs);
  Pj way(proj_create_crs_to_crs_from_pj(context, system.get(), wgs84.get(), nullptr, nullptr));
  if (way) way = Pj(proj_normalize_for_visualization(context, way.get()));
  if (!way) return unknown(context, crs);
  state->toWgs84 = std::move(way);
  return Projection(std::move(state));
}

bool Projection::isGeographic() const { return state_->geographic; }
double Projection::metresPerUnit() const { return state_->unit; }

std::optional<LonLat> Projection::toDegrees(const Vec2& xy) const {
  PJ* way = state_->toWgs84.get();
  proj_errno_reset(way);
  const PJ_COORD out = proj_trans(way, state_->inverted ? PJ_INV : PJ_FWD, proj_coord(xy.x, xy.y, 0.0, HUGE_VAL));
  if (!isFinite(out)) return std::nullopt;
  const double unit = state_->inverted ? 180.0 / std::numbers::pi : 1.0;
  return LonLat{out.xy.x * unit, out.xy.y * unit};
}

std::optional<Vec2> Projection::fromDegrees(const LonLat& place) const {
  PJ* way = state_->toWgs84.get();
  proj_errno_reset(way);
  const double unit = state_->inverted ? std::numbers::pi / 180.0 : 1.0;
  const PJ_COORD out = proj_trans(way, state_->inverted ? PJ_FWD : PJ_INV,
                                  proj_coord(place.longitude * unit, place.latitude * unit, 0.0, HUGE_VAL));
  if (!isFinite(out)) return std::nullopt;
  return Vec2(out.xy.x, out.xy.y);
}

std::optional<Angle> Projection::trueNorth(const Vec2& xy) const {
  const auto here = toDegrees(xy);
  if (!here) return std::nullopt;
  // At the northern edge of the world the step goes the other way.
  const double step = here->latitude > 89.0 ? -kNorthStep : kNorthStep;
  const auto there = fromDegrees({here->longitude, here->latitude + step});
  const auto back = fromDegrees(*here);
  if (!there || !back) return std::nullopt;
  const Vec2 way = (*there - *back) * (step < 0.0 ? -1.0 : 1.0);
  return Angle::radians(std::atan2(way.x, way.y));
}

std::string localCrs(const LonLat& place) {
  return fmt::format("+proj=tmerc +lat_0={:.6f} +lon_0={:.6f} +k=1 +x_0=0 +y_0=0 +ellps=WGS84 +units=m", place.latitude,
                     place.longitude);
}

std::string shortName(const std::string& crs) {
  for (const std::string_view authority : {"EPSG", "OGC", "ESRI"}) {
    const auto at = crs.find(authority);
    if (at == std::string::npos) continue;
    const auto code = crs.find_last_of(":/");
    if (code == std::string::npos || code < at) return crs;
    return std::string(authority) + ":" + crs.substr(code + 1);
  }
  return crs;
}

double distance(const LonLat& a, const LonLat& b) {
  const auto radians = [](double degrees) { return degrees * std::numbers::pi / 180.0; };
  const double south = std::sin(radians(b.latitude - a.latitude) / 2.0);
  const double east = std::sin(radians(b.longitude - a.longitude) / 2.0);
  const double h = south * south + std::cos(radians(a.latitude)) * std::cos(radians(b.latitude)) * east * east;
  return 2.0 * kEarthRadius * std::asin(std::min(1.0, std::sqrt(h)));
}

}  // namespace umbrage::geo
