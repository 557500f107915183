#include "umbrage/cut/detail/borders.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::cut::detail {
namespace {

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
  Gatherer(const Casters& casters, const Face& face) : casters_(casters), face_(face), light_(casters.light) {}

  Borders gather() {
    silhouettes();
    contacts();
    return std::move(out_);
  }

 private:
  void keepOverFace(Clip& clip, const Projected& a, const Projected& b) const {
    for (const Vec3& inside : face_.inside) clip.keep(glm::dot(inside, a), glm::dot(inside, b));
  }

  // A way from `a` to `b`, projected, of which `clip` is left.
  void add(const Projected& a, const Projected& b, const Clip& clip, const Vec3& line) {
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

  /// An edge of the casters over the face.
  struct Edge {
    Vec3 from, to;
    Projected a, b;
    double heightA, heightB;
    Clip clip;  ///< to what lies over the face, seen from the light
    [[nodiscard]] double highest() const {
      const double slope = heightB - heightA;
      return heightA + std::max(clip.begin() * slope, clip.end() * slope);
    }
  };
  [[nodiscard]] Edge edgeOver(std::uint32_t edge) const {
    const shadow::CasterEdge& e = casters_.set.edges[edge];
    Edge out{casters_.set.position(e.a), casters_.set.position(e.b), {}, {}, 0.0, 0.0, {}};
    out.a = face_.project(out.from), out.b = face_.project(out.to);
    out.heightA = face_.height(out.from), out.heightB = face_.height(out.to);
    keepOverFace(out.clip, out.a, out.b);
    return out;
  }

  // Above this height an edge's triangles are all before the face.
  [[nodiscard]] double nothingOf(std::uint32_t edge) const {
    const shadow::CasterEdge& e = casters_.set.edges[edge];
    double reach = face_.reach;
    for (std::uint32_t u = e.begin; u < e.end; ++u)
      reach = std::max(reach, double(casters_.reach[casters_.set.uses[u].triangle]));
    return trace::resolution(reach);
  }

  void addEdge(const Edge& e) {
    const Vec3 towards = Vec3(light_) - e.from * light_.w;
    add(e.a, e.b, e.clip, lineOf(glm::cross(e.to - e.from, towards), e.from));
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
      Edge edge = edgeOver(casters_.borders[item]);
      if (edge.clip.empty() || edge.highest() <= nothingOf(casters_.borders[item])) return true;
      edge.clip.keep(edge.heightA, edge.heightB);
      addEdge(edge);
      return true;
    });
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
    // What lies so high over the face, seen from a low light, may stand beside it.
    box.min -= Vec3(margin / face_.sine), box.max += Vec3(margin / face_.sine);
    const Vec3 normal = face_.up;
    const double offset = glm::dot(normal, face_.frame.origin);
    const auto meets = [&](const Box3& other) {
      if (glm::any(glm::lessThan(other.max, box.min)) || glm::any(glm::lessThan(box.max, other.min))) return false;
      const Vec3 centre = 0.5 * (other.min + other.max), half = other.max - centre;
      return std::abs(glm::dot(normal, centre) - offset) <= glm::dot(glm::abs(normal), half) + margin;
    };
    casters_.hidingTree.visit(meets, [&](std::uint32_t item) {
      const std::uint32_t t = casters_.hiding[item];
      if (!isBefore(casters_, face_, t)) return true;
      pierce(t);
      standOn(t);
      return true;
    });
  }

  // A caster with parts on both sides of the face's plane.
  void pierce(std::uint32_t t) {
    std::array<Vec3, 3> corners, points;
    std::array<double, 3> heights;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = casters_.set.corner(t, static_cast<int>(k));
      heights[k] = face_.height(corners[k]);
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      if (heights[i] == 0.0) points[count++] = corners[i];
      if (heights[i] * heights[j] < 0.0 && count < 3)
        points[count++] = corners[i] + (heights[i] / (heights[i] - heights[j])) * (corners[j] - corners[i]);
    }
    if (count != 2) return;
    const Projected a(face_.frame.flat(points[0]), 1.0), b(face_.frame.flat(points[1]), 1.0);
    Clip clip;
    keepOverFace(clip, a, b);
    if (clip.empty()) return;
    add(a, b, clip, lineOf(glm::cross(corners[1] - corners[0], corners[2] - corners[0]), corners[0]));
  }

  // At an edge that lies on the face only the casters before it count; those on its plane hide nothing of it.
  void standOn(std::uint32_t t) {
    for (const std::uint32_t edge : casters_.edges[t]) {
      const Edge over = edgeOver(edge);
      const double nothing = nothingOf(edge);
      if (over.clip.empty() || std::abs(over.highest()) > nothing) continue;
      const shadow::CasterEdge& e = casters_.set.edges[edge];
      int change = 0;
      std::uint32_t first = ~0u;
      for (std::uint32_t u = e.begin; u < e.end; ++u) {
        const auto& use = casters_.set.uses[u];
        if (casters_.side[use.triangle] == 0 || !isBefore(casters_, face_, use.triangle)) continue;
        first = std::min(first, use.triangle);
        change += use.sign * casters_.side[use.triangle];
      }
      if (change != 0 && first == t) addEdge(over);
    }
  }

  const Casters& casters_;
  const Face& face_;
  const Vec4 light_;
  Borders out_;
};

}  // namespace

Borders bordersOn(const Casters& casters, const Face& face) { return Gatherer(casters, face).gather(); }

}  // namespace umbrage::cut::detail
