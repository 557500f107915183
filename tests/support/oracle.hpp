#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "umbrage/math/predicates.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/scene/light.hpp"
#include "umbrage/scene/surfaces.hpp"

/// The mask's definition by brute force: every triangle asked for every pixel, in double precision, with formulas of its own
/// (Moeller and Trumbore, 1997), no tree, no lifted starts. It says when it is too close to call.
namespace umbrage::oracle {

enum class Answer { no, yes, unclear };

struct Crossing {
  Answer answer = Answer::no;
  double t = 0.0;
};

/// Where a ray meets a triangle. `margin`: barycentric distance from the border below which the answer is unclear.
inline Crossing meet(const Vec3& from, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c,
                     double margin) {
  const Vec3 e1 = b - a, e2 = c - a, p = glm::cross(direction, e2);
  const double determinant = glm::dot(e1, p);
  // Relative to its largest possible value: edge-on within rounding, or no area.
  if (std::abs(determinant) <= 1e-13 * glm::length(e1) * glm::length(e2) * glm::length(direction)) return {};
  const Vec3 s = from - a, q = glm::cross(s, e1);
  const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
  const double inside = std::min({u, v, 1.0 - u - v});
  if (inside < -margin) return {};
  return {inside < margin ? Answer::unclear : Answer::yes, glm::dot(e2, q) / determinant};
}

struct Pixel {
  bool covered = false;
  bool lit = false;
  bool clear = true;  ///< false: on an edge of something, or between two surfaces that coincide
  std::uint32_t triangle = 0;
  Vec3 point{0.0};
};

class Oracle {
 public:
  explicit Oracle(const scene::Surfaces& surfaces) : surfaces_(surfaces) {
    const Box3& b = surfaces.bounds;
    if (!b.empty()) size_ = glm::length(glm::max(glm::abs(b.min), glm::abs(b.max)));
  }

  /// What the pixel (x, y), with whole numbers plus 0.5 at centres, shows under `light`.
  [[nodiscard]] Pixel look(const scene::Camera& camera, const scene::Light& light, double x, double y) const {
    const Vec3 eye = camera.eye - surfaces_.origin, direction = scene::pixelRays(camera).through(x, y);
    Pixel pixel = nearest(eye, direction);
    if (!pixel.covered) return pixel;
    const Vec4 l = scene::homogeneous(light, surfaces_.origin);
    const Vec3 towards = scene::towardsLight(l, pixel.point), n = surfaces_.normal(pixel.triangle);
    const double eyeSide = -glm::dot(n, direction) / glm::length(direction),
                 lightSide = glm::dot(n, towards) / glm::length(towards);
    if (std::min(std::abs(eyeSide), std::abs(lightSide)) <= 1e-12 * glm::length(n)) pixel.clear = false;
    if (eyeSide * lightSide <= 0.0 || !scene::insideCone(light, pixel.point + surfaces_.origin)) return pixel;
    const Answer shadowed = hidden(pixel.point, towards, l.w != 0.0);
    pixel.lit = shadowed == Answer::no;
    pixel.clear = pixel.clear && shadowed != Answer::unclear;
    return pixel;
  }

  /// Whether a caster lies between a point on a surface and the light; casters that touch `besides`, if
  /// given, are left out.
  [[nodiscard]] Answer hidden(const Vec3& point, const Vec3& towards, bool finite,
                              const Vec3* besides = nullptr) const {
    Answer answer = Answer::no;
    const double near = 1e-10 * size_ / glm::length(towards);
    for (std::uint32_t t = 0; t < surfaces_.triangles.size(); ++t) {
      if (surfaces_.casts[t] == 0) continue;
      const Crossing hit =
          meet(point, towards, surfaces_.corner(t, 0), surfaces_.corner(t, 1), surfaces_.corner(t, 2), 1e-7);
      if (hit.answer == Answer::no || hit.t <= near || (finite && hit.t >= 1.0 - 1e-12)) continue;
      if (besides != nullptr && touches(t, *besides)) continue;
      if (hit.answer == Answer::yes) return Answer::yes;
      answer = Answer::unclear;
    }
    return answer;
  }

 private:
  [[nodiscard]] bool touches(std::uint32_t t, const Vec3& p) const {
    return distanceToTriangle(p, surfaces_.corner(t, 0), surfaces_.corner(t, 1), surfaces_.corner(t, 2)) <=
           1e-9 * size_;
  }

  [[nodiscard]] Pixel nearest(const Vec3& eye, const Vec3& direction) const {
    Pixel pixel;
    double best = std::numeric_limits<double>::infinity(), second = best;
    for (std::uint32_t t = 0; t < surfaces_.triangles.size(); ++t) {
      const Crossing hit =
          meet(eye, direction, surfaces_.corner(t, 0), surfaces_.corner(t, 1), surfaces_.corner(t, 2), 1e-7);
      if (hit.answer == Answer::no || hit.t <= 0.0) continue;
      // By definition: a surface in whose plane the eye lies, as far as it can be drawn, shows nothing.
      if (liesInPlane(surfaces_.corner(t, 0), surfaces_.corner(t, 1), surfaces_.corner(t, 2), eye)) continue;
      if (hit.t < best) {
        second = std::exchange(best, hit.t);
        pixel.triangle = t;
        pixel.covered = true;
        pixel.clear = hit.answer == Answer::yes;
      } else {
        second = std::min(second, hit.t);
      }
    }
    // Single precision cannot tell which of two surfaces this close together is in front.
    if (pixel.covered && second - best <= 1e-5 * (best + size_ / glm::length(direction))) pixel.clear = false;
    pixel.point = eye + best * direction;
    return pixel;
  }

  const scene::Surfaces& surfaces_;
  double size_ = 1.0;
};

/// True when the answer changes within an eighth of a pixel, which is as sharp as ray_traced promises borders (LightRays, law 3).
inline bool onEdge(const Oracle& truth, const scene::Camera& camera, const scene::Light& light, int x, int y,
                   const Pixel& centre) {
  for (const double dy : {-0.13, 0.0, 0.13}) {
    for (const double dx : {-0.13, 0.0, 0.13}) {
      const Pixel beside = truth.look(camera, light, x + 0.5 + dx, y + 0.5 + dy);
      if (beside.covered != centre.covered || beside.lit != centre.lit) return true;
    }
  }
  return false;
}

}  // namespace umbrage::oracle
