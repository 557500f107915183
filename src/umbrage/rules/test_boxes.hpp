#pragma once

// Boxes, and what the sun does behind them, worked out moment by moment without the library's own hours.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "umbrage/rules/detail/spans.hpp"
#include "umbrage/rules/targets.hpp"
#include "umbrage/sun/zone.hpp"

namespace umbrage::rules::testing_boxes {

using namespace std::chrono_literals;

struct Block {
  Vec3 min{0.0}, max{0.0};
  std::string name = "block";
};

inline mesh::Mesh meshOf(const Block& b) {
  mesh::Mesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.push_back(
        {(i & 1) != 0 ? b.max.x : b.min.x, (i & 2) != 0 ? b.max.y : b.min.y, (i & 4) != 0 ? b.max.z : b.min.z});
  constexpr std::uint32_t kFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& f : kFaces) {
    m.triangles.push_back({f[0], f[1], f[2]});
    m.triangles.push_back({f[0], f[2], f[3]});
  }
  return m;
}

inline scene::Scene sceneOf(const std::vector<Block>& blocks) {
  scene::Scene s;
  s.materials.push_back({});
  for (const Block& b : blocks) {
    s.instances.push_back({b.name, static_cast<std::uint32_t>(s.meshes.size())});
    s.meshes.push_back(std::make_shared<const mesh::Mesh>(meshOf(b)));
  }
  return s;
}

/// Does the ray from p along s meet the box, by its slabs?
inline bool meets(const Block& b, const Vec3& p, const Vec3& s) {
  double near = 0.0, far = 1e300;
  for (int k = 0; k < 3; ++k) {
    if (s[k] == 0.0) {
      if (p[k] < b.min[k] || p[k] > b.max[k]) return false;
      continue;
    }
    const double a = (b.min[k] - p[k]) / s[k], c = (b.max[k] - p[k]) / s[k];
    near = std::max(near, std::min(a, c)), far = std::min(far, std::max(a, c));
  }
  return near < far && far > 1e-9;
}

inline sun::Instant at(const sun::Zone& zone, const sun::Place& place, std::chrono::year_month_day date,
                       std::chrono::milliseconds time) {
  return sun::instantOf(zone, place, {date, time})->instant;
}

/// One stretch of a day, with the sun's way in it, looked at every `step`.
struct Look {
  study::SunCourse course;
  double leastHeight = 0.0;  ///< sine of the least altitude
  std::vector<Vec3> suns;
  std::chrono::milliseconds step;

  Look(const sun::Place& place, const study::TimeSpan& span, double leastAltitude,
       std::chrono::milliseconds every = 20s, const study::SunModel& model = {})
      : course(study::SunCourse::make(place, span, model)),
        leastHeight(std::sin(leastAltitude * M_PI / 180.0)),
        step(every) {
    for (sun::Instant t = span.from; t < span.to; t += step) suns.push_back(course.towards(t));
  }

  /// When `says` holds, the ends to 5 ms; what is shorter than a step may be missed.
  template <class Fn>
  [[nodiscard]] detail::Spans when(Fn&& says) const {
    detail::Spans spans;
    const study::TimeSpan& all = course.span();
    const auto holds = [&](const Vec3& s) { return s.z > 0.0 && s.z >= leastHeight && says(s); };
    const auto border = [&](sun::Instant a, sun::Instant b, bool atA) {
      while (b - a > 5ms) {
        const sun::Instant m = a + (b - a) / 2;
        (holds(course.towards(m)) == atA ? a : b) = m;
      }
      return b;
    };
    bool before = false;
    sun::Instant since{};
    for (std::size_t i = 0; i < suns.size(); ++i) {
      const sun::Instant t = all.from + step * static_cast<std::int64_t>(i);
      const bool now = holds(suns[i]);
      if (now != before && now) since = i == 0 ? t : border(t - step, t, false);
      if (now != before && !now) spans.push_back({since, border(t - step, t, true)});
      before = now;
    }
    if (before) spans.push_back({since, all.to});
    return spans;
  }
};

inline bool facing(const study::Receiver& r, const Vec3& s) {
  return glm::length(r.normal) == 0.0 || glm::dot(r.normal, s) > 0.0;
}
inline bool hidden(const std::vector<Block>& blocks, const study::Receiver& r, const Vec3& s) {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return meets(b, r.position, s); });
}
inline bool lit(const std::vector<Block>& blocks, const study::Receiver& r, const Vec3& s) {
  return facing(r, s) && !hidden(blocks, r, s);
}

inline outline::Region rectangle(const Vec2& min, const Vec2& max) {
  outline::Region region;
  region.polygons.push_back({{min, {max.x, min.y}, max, {min.x, max.y}}, {}});
  region.area = (max.x - min.x) * (max.y - min.y);
  return region;
}

inline sun::Place place(double latitude, double longitude) {
  return {Angle::degrees(latitude), Angle::degrees(longitude)};
}

}  // namespace umbrage::rules::testing_boxes
