#include "umbrage/cut/detail/borders.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::cut::detail {
namespace {

/// A point of the face as the light projects it: (u w, v w, w), w > 0.
using Projected = Vec3;

/// The part of a straight way, from parameter `begin` to `end`, on which some linear functions are not negative.
class Clip {
 public:
  // A function's values at the ends of the way.
  void keep(double atStart, double atEnd) {
    if (atStart >= 0.0 && atEnd >= 0.0) return;
    if (atStart < 0.0 && atEnd < 0.0) return void(end_ = -1.0);
    const double zero = atStart / (atStart - atEnd);
    if (atStart < 0.0)
      begin_ = std::max(begin_, zero);
    else
      end_ = std::min(end_, zero);
  }
  [[nodiscard]] bool empty() const { return begin_ > end_; }
  [[nodiscard]] double begin() const { return begin_; }
  [[nodiscard]] double end() const { return end_; }

 private:
  double begin_ = 0.0, end_ = 1.0;
};

class Gatherer {
 public:
  Gatherer(const Casters& casters, const Face& face) : casters_(casters), face_(face), light_(casters.light) {
    const auto& f = face_.frame.flatCorners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 along = f[(k + 1) % 3] - f[k];
      const Vec2 inwards = Vec2(-along.y, along.x) / glm::length(along);
      inside_[k] = Vec3(inwards, -glm::dot(inwards, f[k]));
    }
    lightFlat_ = light_.w != 0.0 ? face_.frame.flat(Vec3(light_))
                                 : Vec2(glm::dot(face_.frame.e1, Vec3(light_)), glm::dot(face_.frame.e2, Vec3(light_)));
  }

  Borders gather() {
    silhouettes();
    contacts();
    return std::move(out_);
  }

 private:
  // Away from the light onto the face's plane. The same numbers come out relative to the light and to the face; what is nearer loses less by rounding.
  [[nodiscard]] Projected project(const Vec3& p) const {
    const FaceFrame& f = face_.frame;
    const Vec3 x = p - f.origin, y = p - Vec3(light_);
    const bool fromLight = light_.w != 0.0 && glm::dot(y, y) < glm::dot(x, x);
    const Vec3& from = fromLight ? y : x;
    const double up = glm::dot(face_.up, from), h = face_.lightHeight;
    return {glm::dot(f.e1, from) * h - lightFlat_.x * up, glm::dot(f.e2, from) * h - lightFlat_.y * up,
            fromLight ? -up : h - light_.w * up};
  }

  // A way from `a` to `b`, projected, of which `clip` is left.
  void add(const Projected& a, const Projected& b, Clip clip, Vec3 line) {
    for (const Vec3& inside : inside_) clip.keep(glm::dot(inside, a), glm::dot(inside, b));
    if (clip.empty()) return;
    const double length = glm::length(Vec2(line));
    if (!(length > 0.0) || !std::isfinite(length)) return;
    const Projected p = a + clip.begin() * (b - a), q = a + clip.end() * (b - a);
    if (!(p.z > 0.0 && q.z > 0.0)) return;
    const Vec2 from = Vec2(p) / p.z, to = Vec2(q) / q.z;
    if (!(glm::length(to - from) > face_.tolerance)) return;
    out_.borders.push_back({from, to, static_cast<std::uint32_t>(out_.lines.size())});
    out_.lines.push_back(line / length);
  }

  // The plane through `on` with a normal, as a line on the face.
  [[nodiscard]] Vec3 lineOf(const Vec3& normal, const Vec3& on) const {
    const FaceFrame& f = face_.frame;
    return {glm::dot(normal, f.e1), glm::dot(normal, f.e2), glm::dot(normal, f.origin - on)};
  }

  void addEdge(std::uint32_t edge, bool standsOnFace) {
    const shadow::CasterEdge& e = casters_.set.edges[edge];
    const Vec3 a = casters_.set.position(e.a), b = casters_.set.position(e.b);
    Clip clip;
    if (!standsOnFace) clip.keep(face_.height(a), face_.height(b));
    if (clip.empty()) return;
    const Vec3 towards = Vec3(light_) - a * light_.w;
    add(project(a), project(b), clip, lineOf(glm::cross(b - a, towards), a));
  }

  // --- edges between the face and the light -----------------------------------------------------------------------------------

  void silhouettes() {
    std::array<Vec4, 4> planes;
    const double margin = 0x1p-20 * largestCoordinate();
    const auto& c = face_.frame.corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 towards = Vec3(light_) - c[k] * light_.w;
      Vec3 normal = glm::normalize(glm::cross(c[(k + 1) % 3] - c[k], towards));
      if (glm::dot(normal, c[(k + 2) % 3] - c[k]) < 0.0) normal = -normal;
      planes[k] = Vec4(normal, margin - glm::dot(normal, c[k]));
    }
    planes[3] = Vec4(face_.up, margin - glm::dot(face_.up, face_.frame.origin));
    const auto meets = [&](const Box3& box) {
      const Vec3 centre = 0.5 * (box.min + box.max), half = box.max - centre;
      return std::all_of(planes.begin(), planes.end(), [&](const Vec4& plane) {
        return glm::dot(Vec3(plane), centre) + plane.w + glm::dot(glm::abs(Vec3(plane)), half) >= 0.0;
      });
    };
    casters_.borderTree.visit(meets, [&](std::uint32_t item) {
      const std::uint32_t edge = casters_.borders[item];
      if (isBefore(edge)) addEdge(edge, false);
      return true;
    });
  }

  // Whether an end of it is.
  [[nodiscard]] bool isBefore(std::uint32_t edge) const {
    const shadow::CasterEdge& e = casters_.set.edges[edge];
    const auto before = [&](const Vec3& p) { return face_.sideOf(p, face_.height(p)) > 0; };
    return before(casters_.set.position(e.a)) || before(casters_.set.position(e.b));
  }

  [[nodiscard]] double largestCoordinate() const {
    double most = 0.0;
    for (const Vec3& p : face_.frame.corners) most = std::max(most, trace::largest(p));
    return std::max({most, trace::largest(casters_.set.bounds.min), trace::largest(casters_.set.bounds.max)});
  }

  // --- casters that meet the face -----------------------------------------------------------------------------------------------

  void contacts() {
    Box3 box;
    for (const Vec3& p : face_.frame.corners) box.add(p);
    const double margin = 4.0 * trace::resolution(largestCoordinate());
    box.min -= Vec3(margin), box.max += Vec3(margin);
    const Vec3 normal = face_.up;
    const double offset = glm::dot(normal, face_.frame.origin);
    const auto meets = [&](const Box3& other) {
      if (glm::any(glm::lessThan(other.max, box.min)) || glm::any(glm::lessThan(box.max, other.min))) return false;
      const Vec3 centre = 0.5 * (other.min + other.max), half = other.max - centre;
      return std::abs(glm::dot(normal, centre) - offset) <= glm::dot(glm::abs(normal), half) + margin;
    };
    casters_.hidingTree.visit(meets, [&](std::uint32_t item) {
      const std::uint32_t t = casters_.hiding[item];
      const Standing s = standing(casters_, face_, t);
      if (s.crosses()) pierce(t, s);
      if (s.before()) standOn(t, s);
      return true;
    });
  }

  void pierce(std::uint32_t t, const Standing& s) {
    std::array<Vec3, 3> points;
    std::size_t count = 0;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k), j = (i + 1) % 3;
      const Vec3 a = casters_.set.corner(t, k), b = casters_.set.corner(t, static_cast<int>(j));
      if (s.at[i] == 0) points[count++] = a;
      if (s.at[i] * s.at[j] < 0) points[count++] = a + (s.heights[i] / (s.heights[i] - s.heights[j])) * (b - a);
    }
    if (count != 2) return;
    const trace::Corners c = casters_.corners(t);
    const Vec3 normal = glm::cross(c.b - c.a, c.c - c.a);
    add(Vec3(face_.frame.flat(points[0]), 1.0), Vec3(face_.frame.flat(points[1]), 1.0), {}, lineOf(normal, c.a));
  }

  // At an edge that lies on the face only the casters before it count; those on its plane hide nothing of it.
  void standOn(std::uint32_t t, const Standing& s) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t edge = casters_.edges[t][k];
      const shadow::CasterEdge& e = casters_.set.edges[edge];
      const auto& corners = casters_.set.triangles[t];
      int on = 0;
      for (std::size_t i = 0; i < 3; ++i) on += (corners[i] == e.a || corners[i] == e.b) && s.at[i] == 0;
      if (on != 2) continue;
      int change = 0;
      std::uint32_t first = ~0u;
      for (std::uint32_t u = e.begin; u < e.end; ++u) {
        const auto& use = casters_.set.uses[u];
        if (casters_.side[use.triangle] == 0 || !standing(casters_, face_, use.triangle).before()) continue;
        first = std::min(first, use.triangle);
        change += use.sign * casters_.side[use.triangle];
      }
      if (change != 0 && first == t) addEdge(edge, true);
    }
  }

  const Casters& casters_;
  const Face& face_;
  const Vec4 light_;
  Vec2 lightFlat_{0.0};  ///< the light's own place over the face, or its direction's
  std::array<Vec3, 3> inside_;
  Borders out_;
};

}  // namespace

Borders bordersOn(const Casters& casters, const Face& face) { return Gatherer(casters, face).gather(); }

}  // namespace umbrage::cut::detail
