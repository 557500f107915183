#include "umbrage/render/large_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/averted_faces.hpp"
#include "umbrage/shadow/tinted_silhouette.hpp"

namespace umbrage::render {
namespace {

// Sine of the angle at which the eye sees the plane. Measured over the conformance scenes: from 2^-20 to 2^-11 not a pixel
// changes; with 2^-8 some lose the precision they need, and with none at all the rounding of the corners is magnified.
constexpr double kFlatSine = 0x1p-14;

// The corners of a triangle as seen from the eye.
struct Seen {
  Vec3 a, b, c;
  double nearest, farthest;  ///< depths

  Seen(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& forward) : a(p), b(q), c(r) {
    std::tie(nearest, farthest) = std::minmax({glm::dot(a, forward), glm::dot(b, forward), glm::dot(c, forward)});
  }

  [[nodiscard]] bool isLarge() const {
    if (farthest <= 0.0) return false;  // not seen
    const double extent = std::max({glm::dot(b - a, b - a), glm::dot(c - a, c - a), glm::dot(c - b, c - b)});
    return nearest <= 0.0 || extent > nearest * nearest;
  }

  [[nodiscard]] Vec4f plane() const {
    const Vec3 normal = glm::cross(b - a, c - a);
    const double height = glm::dot(normal, a), size = glm::length(normal) * glm::length(a);
    if (std::abs(height) <= kFlatSine * size) return {0.0f, 0.0f, 0.0f, -1.0f};
    const double most = nearest > 0.0 ? 1.0 / nearest : double(std::numeric_limits<float>::max());
    return Vec4f(Vec3f(normal / height), static_cast<float>(most));
  }
};

// The half-spaces that bound the picture, with the eye as their apex, one bit each; a triangle beyond one is not seen.
class Outcodes {
 public:
  Outcodes(const View& view, int width, int height)
      : right_(row(view, 0)),
        up_(row(view, 1)),
        forward_(row(view, 3)),
        wide_(1.0 + kMargin / width),
        high_(1.0 + kMargin / height) {}

  [[nodiscard]] std::uint8_t of(const Vec3& fromEye) const {
    const double x = glm::dot(right_, fromEye), y = glm::dot(up_, fromEye), w = glm::dot(forward_, fromEye);
    return static_cast<std::uint8_t>((x > wide_ * w) | (x < -wide_ * w) << 1 | (y > high_ * w) << 2 |
                                     (y < -high_ * w) << 3 | (w < 0.0) << 4);
  }

 private:
  static constexpr double kMargin = 8.0;  // four pixels, far beyond any rounding
  static Vec3 row(const View& view, int i) { return {view.toClip[0][i], view.toClip[1][i], view.toClip[2][i]}; }
  Vec3 right_, up_, forward_;
  double wide_, high_;
};

// Per surface: 1 when it is not to be drawn, or surely hidden by others of the same solid.
std::vector<std::uint8_t> notDrawn(const shadow::Geometry& geometry, const Vec3& eye, Drawn drawn) {
  std::vector<std::uint8_t> out = shadow::avertedFaces(geometry, eye);
  if (drawn == Drawn::all) return out;
  const shadow::CasterSet& casters = geometry.casters;
  const std::vector<std::uint8_t> veiled = shadow::veiledComponents(casters, geometry.filters);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (veiled[casters.componentOf[t]] != 0) out[casters.surfaceTriangle[t]] = 0;
  for (std::uint32_t t = 0; t < out.size(); ++t)
    if (geometry.filters.isVeil(t) != (drawn == Drawn::veils)) out[t] = 1;
  return out;
}

}  // namespace

Arrangement arrange(const shadow::Geometry& geometry, const View& view, int width, int height, Drawn drawn) {
  const scene::Surfaces& surfaces = geometry.surfaces;
  const Vec3 eye = view.eye - surfaces.origin;
  const Vec3 forward(view.toClip[0][3], view.toClip[1][3], view.toClip[2][3]);
  const Outcodes outcodes(view, width, height);
  std::vector<std::uint8_t> code;
  code.reserve(surfaces.positions.size());
  for (const Vec3f& p : surfaces.positions) code.push_back(outcodes.of(Vec3(p) - eye));
  const std::vector<std::uint8_t> leftOut = notDrawn(geometry, eye, drawn);
  Arrangement out;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    const mesh::Triangle& corners = surfaces.triangles[t];
    if (leftOut[t] != 0 || (code[corners[0]] & code[corners[1]] & code[corners[2]]) != 0) continue;
    const Vec3 a = surfaces.corner(t, 0), b = surfaces.corner(t, 1), c = surfaces.corner(t, 2);
    if (liesInPlane(a, b, c, eye)) continue;
    const Seen seen(a - eye, b - eye, c - eye, forward);
    if (seen.isLarge())
      out.large.push_back({seen.plane(), t, {}});
    else
      out.ordinary.push_back(t);
  }
  return out;
}

}  // namespace umbrage::render
