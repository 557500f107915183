#include "umbrage/cut/face_cut.hpp"

#include <utility>

namespace umbrage::cut {

FaceFrame FaceFrame::of(const std::array<Vec3, 3>& corners) {
  FaceFrame f;
  f.corners = corners;
  f.origin = corners[0];
  const Vec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length = glm::length(normal);
  if (!(length > 0.0)) return f;
  f.normal = normal / length;
  f.e1 = glm::normalize(corners[1] - corners[0]);
  f.e2 = glm::cross(f.normal, f.e1);
  for (std::size_t k = 0; k < 3; ++k) f.flatCorners[k] = f.flat(corners[k]);
  return f;
}

Vec3 FaceFrame::space(const Vec2& p) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (p == flatCorners[k]) return corners[k];
  return origin + p.x * e1 + p.y * e2;
}

bool split(const Polygon& polygon, const Vec3& line, double tolerance, Polygon& below, Polygon& above, int& side) {
  below.clear(), above.clear();
  const auto height = [&](const Vec2& p) {
    const double h = line.x * p.x + line.y * p.y + line.z;
    return h > tolerance || h < -tolerance ? h : 0.0;
  };
  bool anyBelow = false, anyAbove = false;
  for (const Vec2& p : polygon) {
    const double h = height(p);
    anyBelow = anyBelow || h < 0.0;
    anyAbove = anyAbove || h > 0.0;
  }
  side = anyBelow ? -1 : +1;
  if (!anyBelow || !anyAbove) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double hp = height(p), hq = height(q);
    if (hp <= 0.0) below.push_back(p);
    if (hp >= 0.0) above.push_back(p);
    if (hp * hq >= 0.0) continue;
    const Vec2 between = p + (hp / (hp - hq)) * (q - p);
    below.push_back(between);
    above.push_back(between);
  }
  return true;
}

FaceCut::FaceCut(const FaceFrame& frame, double tolerance, std::vector<Node> nodes, std::int32_t root)
    : origin_(frame.origin),
      e1_(frame.e1),
      e2_(frame.e2),
      tolerance_(tolerance),
      nodes_(std::move(nodes)),
      root_(root) {}

bool FaceCut::isLit(const Vec3& point) const {
  const Vec3 p(glm::dot(point - origin_, e1_), glm::dot(point - origin_, e2_), 1.0);
  std::int32_t at = root_;
  while (at >= 0) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    at = node.next[glm::dot(node.line, p) < 0.0 ? 0 : 1];
  }
  return at == kLit;
}

void FaceCut::visitPieces(const Polygon& part, const std::function<void(const Polygon&, bool)>& visit) const {
  std::vector<std::pair<std::int32_t, Polygon>> open;
  open.emplace_back(root_, part);
  while (!open.empty()) {
    auto [at, polygon] = std::move(open.back());
    open.pop_back();
    if (at < 0) {
      visit(polygon, at == kLit);
      continue;
    }
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    Polygon below, above;
    int side = 0;
    if (split(polygon, node.line, tolerance_, below, above, side)) {
      open.emplace_back(node.next[1], std::move(above));
      open.emplace_back(node.next[0], std::move(below));
    } else {
      open.emplace_back(node.next[side < 0 ? 0 : 1], std::move(polygon));
    }
  }
}

}  // namespace umbrage::cut
