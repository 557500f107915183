#include "umbrage/render/map_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace umbrage::render {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
constexpr double kWidestSpot = 60.0;    ///< wider ones are looked at through a cube
constexpr double kWidestTangent = 3.0;  ///< of one map in the space of a perspective
constexpr double kNearest = 1e-4;       ///< of the light, in radii of what is seen: nearer surfaces count as lit
constexpr double kAlmostParallel = 1e-9;
// Depths of what is seen; outside of them lie casters before it, and rounding.
constexpr double kLowDepth = 0.02, kHighDepth = 0.95;

double value(const Vec4& row, const Vec3& p) { return glm::dot(Vec3(row), p) + row.w; }

/// A way to look from the light, in linear functions of points relative to the eye: (x / w, y / w) is where a point is seen, and depth / w is greater nearer to
/// the light.
struct Look {
  Vec4 x, y, w, depth;
  double limit = kEndless;  ///< largest |x / w| and |y / w|
  double nearest = 0.0;     ///< smallest w
  HalfSpace drawn{0.0, 0.0, 0.0, 1.0};

  [[nodiscard]] std::vector<HalfSpace> borders() const {
    std::vector<HalfSpace> all;
    if (drawn != HalfSpace(0.0, 0.0, 0.0, 1.0)) all.push_back(drawn);
    if (nearest > 0.0) all.push_back(w - Vec4(0.0, 0.0, 0.0, nearest));
    if (limit < kEndless)
      for (const Vec4& row : {x, -x, y, -y}) all.push_back(limit * w - row);
    return all;
  }
};

struct Range {
  double low = kEndless, high = -kEndless;
  void add(double v) { low = std::min(low, v), high = std::max(high, v); }
  [[nodiscard]] bool empty() const { return !(low <= high); }
  [[nodiscard]] Range within(const Range& other) const {
    return {std::max(low, other.low), std::min(high, other.high)};
  }
};

/// What a set of points takes up of a look.
struct Extent {
  Range x, y, depth;
  void add(const Look& look, const Vec3& p) {
    const double w = value(look.w, p);
    x.add(value(look.x, p) / w), y.add(value(look.y, p) / w), depth.add(value(look.depth, p) / w);
  }
};

/// Triangles of casters, and polygons of receivers that face the light, cut off at half-spaces.
class Cutter {
 public:
  explicit Cutter(const MapRequest& request) : request_(request), eye_(request.view.eye - request.surfaces.origin) {}

  template <class Take>
  void receivers(const std::vector<HalfSpace>& borders, const Take& take) {
    for (const SeenReceivers::Polygon& p : request_.receivers.polygons)
      if (request_.facing[p.triangle] != 0) cut(request_.receivers.corners(p), borders, take);
  }

  template <class Take>
  void casters(const std::vector<HalfSpace>& borders, const Take& take) {
    const scene::Surfaces& surfaces = request_.surfaces;
    beyond_.assign(surfaces.positions.size(), 0);
    for (std::size_t i = 0; i < beyond_.size(); ++i)
      for (std::size_t b = 0; b < borders.size(); ++b)
        beyond_[i] |=
            static_cast<std::uint16_t>((value(borders[b], Vec3(surfaces.positions[i]) - eye_) < 0.0 ? 1u : 0u) << b);
    for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
      const mesh::Triangle& c = surfaces.triangles[t];
      if (surfaces.casts[t] == 0 || (beyond_[c[0]] & beyond_[c[1]] & beyond_[c[2]]) != 0) continue;
      const std::array<Vec3, 3> corners{surfaces.corner(t, 0) - eye_, surfaces.corner(t, 1) - eye_,
                                        surfaces.corner(t, 2) - eye_};
      if ((beyond_[c[0]] | beyond_[c[1]] | beyond_[c[2]]) != 0)
        cut(corners, borders, take);
      else
        for (const Vec3& p : corners) take(p);
    }
  }

 private:
  template <class Take>
  void cut(std::span<const Vec3> polygon, const std::vector<HalfSpace>& borders, const Take& take) {
    left_.assign(polygon.begin(), polygon.end());
    for (const HalfSpace& border : borders) {
      const bool crosses = std::ranges::any_of(left_, [&](const Vec3& p) { return value(border, p) < 0.0; });
      if (!crosses) continue;
      clip(left_, border, other_);
      std::swap(left_, other_);
    }
    for (const Vec3& p : left_) take(p);
  }

  const MapRequest& request_;
  Vec3 eye_;
  std::vector<std::uint16_t> beyond_;
  std::vector<Vec3> left_, other_;
};

/// A part of a look that one map covers.
struct Region {
  Look look;
  Range x, y, depth;

  [[nodiscard]] std::vector<HalfSpace> borders() const {
    std::vector<HalfSpace> all = look.borders();
    all.push_back(look.x - x.low * look.w), all.push_back(x.high * look.w - look.x);
    all.push_back(look.y - y.low * look.w), all.push_back(y.high * look.w - look.y);
    return all;
  }

  // Where a point is seen, -1..1 within the region; w > 0 is needed.
  [[nodiscard]] std::optional<Vec2> see(const Vec3& p) const {
    const double w = value(look.w, p);
    if (!(w > look.nearest) || !(value(look.drawn, p) > 0.0)) return std::nullopt;
    const Vec2 at(2.0 * (value(look.x, p) / w - x.low) / (x.high - x.low) - 1.0,
                  2.0 * (value(look.y, p) / w - y.low) / (y.high - y.low) - 1.0);
    return std::max(std::abs(at.x), std::abs(at.y)) <= 1.0 ? std::optional(at) : std::nullopt;
  }

  [[nodiscard]] Mat4 toMap() const {
    const auto across = [&](const Vec4& row, const Range& r) {
      return (2.0 * row - (r.low + r.high) * look.w) / (r.high - r.low);
    };
    const double scale = (kHighDepth - kLowDepth) / (depth.high - depth.low);
    const Vec4 rowX = across(look.x, x), rowY = across(look.y, y);
    const Vec4 rowZ = scale * (look.depth - depth.low * look.w) + kLowDepth * look.w;
    Mat4 m;
    for (int c = 0; c < 4; ++c) m[c] = Vec4(rowX[c], rowY[c], rowZ[c], look.w[c]);
    return m;
  }
};

// A range of one value becomes one of some width.
Range widened(Range r, double least) {
  const double lacks = 0.5 * (least - (r.high - r.low));
  return lacks > 0.0 ? Range{r.low - lacks, r.high + lacks} : r;
}

std::optional<Region> regionOf(Cutter& cutter, const Look& look) {
  Extent receivers, casters;
  cutter.receivers(look.borders(), [&](const Vec3& p) { receivers.add(look, p); });
  if (receivers.x.empty()) return std::nullopt;
  // Casters behind all receivers shade nothing.
  std::vector<HalfSpace> before = look.borders();
  before.push_back(look.depth - receivers.depth.low * look.w);
  cutter.casters(before, [&](const Vec3& p) { casters.add(look, p); });
  Range x = receivers.x.within(casters.x), y = receivers.y.within(casters.y);
  if (x.empty() || y.empty()) return std::nullopt;
  const double size = std::max({x.high - x.low, y.high - y.low, 1e-9 * (std::abs(x.high) + std::abs(y.high)), 1e-30});
  x = widened(x, 1e-3 * size), y = widened(y, 1e-3 * size);
  const double depths = std::max(std::abs(receivers.depth.high), std::abs(receivers.depth.low));
  return Region{look, x, y, widened(receivers.depth, std::max(1e-6 * depths, 1e-30))};
}

// --- how well maps sample the picture -----------------------------------------------------------------------------------

// Pixels that a texel is wide at a sample, were the map that covers it one texel: the mean of both of its axes.
class Sampling {
 public:
  explicit Sampling(const MapRequest& request)
      : request_(request), rays_(scene::pixelRays(request.camera)), eye_(request.view.eye - request.surfaces.origin) {}

  [[nodiscard]] std::optional<double> at(const ViewSample& sample, const Region& region) const {
    if (request_.facing[sample.triangle] == 0) return std::nullopt;
    const Vec3 n = request_.surfaces.normal(sample.triangle), a = request_.surfaces.corner(sample.triangle, 0) - eye_;
    const auto seen = [&](double dx, double dy) -> std::optional<Vec2> {
      const Vec3 ray = rays_.through(sample.pixel.x + dx, sample.pixel.y + dy);
      const double along = glm::dot(n, ray);
      return along != 0.0 ? region.see(ray * (glm::dot(n, a) / along)) : std::nullopt;
    };
    constexpr double kStep = 0.25;
    const auto left = seen(-kStep, 0), right = seen(kStep, 0), top = seen(0, -kStep), bottom = seen(0, kStep);
    if (!left || !right || !top || !bottom) return std::nullopt;
    const Vec2 u = (*right - *left) / (2.0 * kStep), v = (*bottom - *top) / (2.0 * kStep);
    const double area = std::abs(u.x * v.y - u.y * v.x);
    if (!(area > 0.0)) return std::nullopt;
    // The inverse of (u, v) has the norm of the matrix over its determinant; a texel is 2 wide.
    return std::sqrt(2.0 * (glm::dot(u, u) + glm::dot(v, v))) / area;
  }

 private:
  const MapRequest& request_;
  scene::PixelRays rays_;
  Vec3 eye_;
};

MapFit finish(const MapRequest& request, const std::vector<Region>& regions) {
  const Sampling sampling(request);
  MapFit fit;
  double sum = 0.0;
  std::size_t count = 0;
  for (const Region& region : regions) {
    std::vector<double> widths;
    for (const ViewSample& sample : request.receivers.samples)
      if (const auto width = sampling.at(sample, region)) widths.push_back(*width);
    for (const double width : widths) sum += width;
    count += widths.size();
    MapView map{region.toMap(), region.look.drawn};
    if (!widths.empty()) {
      const auto tenth = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() * 9 / 10);
      std::nth_element(widths.begin(), tenth, widths.end());
      map.texelsForPicture = *tenth;
    }
    fit.maps.push_back(map);
  }
  fit.pixelsPerTexel = count > 0 ? sum / double(count) : 0.0;
  return fit;
}

// --- ways to look from the light ----------------------------------------------------------------------------------------

/// A projective space in which the light looks at the scene: (position - eye, 1) to homogeneous coordinates; the scene has w > 0.
struct Space {
  Mat4 to{1.0};
  HalfSpace drawn{0.0, 0.0, 0.0, 1.0};
  double size = 1.0;  ///< of what is seen in it

  [[nodiscard]] Vec4 row(const Vec4& of) const { return glm::transpose(to) * of; }
};

// Unit vectors across an axis, the first as near to `x` as may be.
struct Across {
  Vec3 x, y;
  Across(const Vec3& axis, const Vec3& wanted) {
    Vec3 across = wanted - axis * glm::dot(axis, wanted);
    if (!(glm::dot(across, across) > 1e-6)) {
      const Vec3 other = std::abs(axis.x) < 0.6 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
      across = other - axis * glm::dot(axis, other);
    }
    x = glm::normalize(across);
    y = glm::cross(axis, x);
  }
};

// From a point at infinity; `towards` it.
Look parallelLook(const Space& space, const Vec3& towards, const Vec3& right) {
  const Across across(towards, right);
  const Vec4 w = space.row({0, 0, 0, 1});
  return {space.row(Vec4(across.x, 0)),
          space.row(Vec4(across.y, 0)),
          w,
          space.row(Vec4(towards, 0)),
          kEndless,
          0.0,
          space.drawn};
}

// From a point `centre` along `axis`; `inverted`: what is farther from it is nearer to the light.
Look centralLook(const Space& space, const Vec3& centre, const Vec3& axis, const Vec3& right, double limit,
                 bool inverted) {
  const Across across(axis, right);
  const auto along = [&](const Vec3& d) { return space.row(Vec4(d, -glm::dot(d, centre))); };
  const Vec4 depth = space.row({0, 0, 0, 1});
  return {along(across.x), along(across.y),       along(axis), inverted ? -depth : depth,
          limit,           kNearest * space.size, space.drawn};
}

std::vector<Look> cubeLooks(const Space& space, const Vec3& centre, bool inverted) {
  std::vector<Look> looks;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sense : {1.0, -1.0}) {
      Vec3 d(0.0), right(0.0);
      d[axis] = sense, right[(axis + 1) % 3] = 1.0;
      looks.push_back(centralLook(space, centre, d, right, 1.0, inverted));
    }
  return looks;
}

bool isNarrow(const scene::Light& light) {
  const auto* spot = std::get_if<scene::SpotLight>(&light.shape);
  return spot != nullptr && spot->cutoff <= Angle::degrees(kWidestSpot);
}

std::vector<Look> uniformLooks(const MapRequest& request, const Vec4& light, double size) {
  const Space space{.size = size};
  const scene::CameraBasis axes = scene::basis(request.camera);
  if (light.w == 0.0) return {parallelLook(space, glm::normalize(Vec3(light)), axes.right)};
  if (!isNarrow(request.light)) return cubeLooks(space, Vec3(light), false);
  const auto& spot = std::get<scene::SpotLight>(request.light.shape);
  return {centralLook(space, Vec3(light), glm::normalize(spot.direction), axes.right, tan(spot.cutoff), false)};
}

std::vector<Region> regionsOf(Cutter& cutter, const std::vector<Look>& looks) {
  std::vector<Region> regions;
  for (const Look& look : looks)
    if (const auto region = regionOf(cutter, look)) regions.push_back(*region);
  return regions;
}

Vec4 lightFromEye(const MapRequest& request) { return scene::homogeneous(request.light, request.view.eye); }

double sizeOf(const MapRequest& request) {
  Box3 box;
  for (const Vec3& p : request.receivers.points) box.add(p);
  return std::max(box.radius(), 1e-30);
}

// --- the space of a perspective -----------------------------------------------------------------------------------------

/// What the maps must hold, along the camera's axes and relative to its eye.
struct Held {
  scene::CameraBasis axes;
  std::vector<Vec3> points;
  Range forward;
};

Held heldBy(Cutter& cutter, const MapRequest& request, const std::vector<Region>& regions) {
  Held held{scene::basis(request.camera), {}, {}};
  const auto take = [&](const Vec3& p) {
    held.points.push_back(p);
    held.forward.add(glm::dot(held.axes.forward, p));
  };
  for (const Region& region : regions) {
    std::vector<HalfSpace> borders = region.borders();
    cutter.receivers(borders, take);
    borders.push_back(region.look.depth - region.depth.low * region.look.w);
    cutter.casters(borders, take);
  }
  return held;
}

// A perspective from `back` behind the eye that takes what is held into the cube from -1 to 1.
Space perspectiveSpace(const Held& held, double back) {
  const scene::CameraBasis& axes = held.axes;
  const double near = held.forward.low + back, far = held.forward.high + back;
  double wide = 0.0, high = 0.0;
  for (const Vec3& p : held.points) {
    const double w = glm::dot(axes.forward, p) + back;
    wide = std::max(wide, std::abs(glm::dot(axes.right, p)) / w),
    high = std::max(high, std::abs(glm::dot(axes.up, p)) / w);
  }
  const double a = (far + near) / (far - near), b = -2.0 * far * near / (far - near);
  const Vec4 x(axes.right / std::max(wide, 1e-30), 0.0), y(axes.up / std::max(high, 1e-30), 0.0), w(axes.forward, back);
  const Vec4 z = a * w + Vec4(0.0, 0.0, 0.0, b);
  Space space;
  for (int c = 0; c < 4; ++c) space.to[c] = Vec4(x[c], y[c], z[c], w[c]);
  space.drawn = w - Vec4(0.0, 0.0, 0.0, 0.5 * near);
  return space;
}

std::vector<Look> perspectiveLooks(const Space& space, const Held& held, const Vec4& light, bool cubeToo) {
  const Vec3 right(1, 0, 0);
  const Vec4 l = space.to * light;
  const double size = glm::length(Vec3(l));
  if (std::abs(l.w) <= kAlmostParallel * size) return {parallelLook(space, Vec3(l) / size, right)};
  const Vec3 centre = Vec3(l) / l.w;
  const double distance = glm::length(centre);
  if (distance > 0.0) {
    Look look = centralLook(space, centre, -centre / distance, right, kWidestTangent, l.w < 0.0);
    const bool allIn = std::ranges::all_of(held.points, [&](const Vec3& p) {
      const double w = value(look.w, p);
      return w > look.nearest * value(space.row({0, 0, 0, 1}), p) &&
             std::max(std::abs(value(look.x, p)), std::abs(value(look.y, p))) <= kWidestTangent * w;
    });
    if (allIn) return {look};
  }
  return cubeToo ? cubeLooks(space, centre, l.w < 0.0) : std::vector<Look>();
}

}  // namespace

MapFit uniformMaps(const MapRequest& request) {
  Cutter cutter(request);
  return finish(request, regionsOf(cutter, uniformLooks(request, lightFromEye(request), sizeOf(request))));
}

MapFit perspectiveMaps(const MapRequest& request) {
  Cutter cutter(request);
  const Vec4 light = lightFromEye(request);
  const auto uniform = regionsOf(cutter, uniformLooks(request, light, sizeOf(request)));
  MapFit best = finish(request, uniform);
  if (best.pixelsPerTexel == 0.0) return best;
  const Held held = heldBy(cutter, request, uniform);
  const double depth = held.forward.high - held.forward.low;
  if (!(depth > 0.0)) return best;
  std::vector<double> backs;
  if (held.forward.low > 0.0) backs.push_back(0.0);
  for (double part = 1.0 / 256.0; part <= 4.0; part *= 2.0) backs.push_back(part * depth - held.forward.low);
  for (const double back : backs) {
    if (back < 0.0) continue;
    const Space space = perspectiveSpace(held, back);
    const auto looks = perspectiveLooks(space, held, light, light.w != 0.0 && !isNarrow(request.light));
    const auto regions = regionsOf(cutter, looks);
    if (regions.empty() || regions.size() > uniform.size()) continue;
    MapFit fit = finish(request, regions);
    if (!(fit.pixelsPerTexel > 0.0 && fit.pixelsPerTexel < best.pixelsPerTexel)) continue;
    best = std::move(fit);
    best.movedBack = back;
  }
  return best;
}

}  // namespace umbrage::render
