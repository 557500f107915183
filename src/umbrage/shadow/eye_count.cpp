#include "umbrage/shadow/eye_count.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "umbrage/math/predicates.hpp"

namespace umbrage::shadow {
namespace {

// What float clipping needs around a side quad. Measured: whole screens fail below 1e-5 of the distances in play, single pixels
// up to 1e-3; 1e-4 of the scene's radius with the quad's own extent added left no error in thousands of attacks.
constexpr double kRelativeThreshold = 1e-4;

double squared(const Vec3& v) { return glm::dot(v, v); }

double squaredToSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length = squared(ab);
  const double t = length > 0.0 ? std::clamp(glm::dot(p - a, ab) / length, 0.0, 1.0) : 0.0;
  return squared(p - a - t * ab);
}

double squaredToRay(const Vec3& p, const Vec3& start, const Vec3& direction) {
  const double length = squared(direction);
  const double t = length > 0.0 ? std::max(0.0, glm::dot(p - start, direction) / length) : 0.0;
  return squared(p - start - t * direction);
}

// A side: the edge a-b and everything behind it as the light sees it, along da from a and along db from b.
struct Side {
  Vec3 a, b, da, db;
};

Side sideOf(const Vec3& a, const Vec3& b, const Vec4& light) {
  return {a, b, a * light.w - Vec3(light), b * light.w - Vec3(light)};
}

// True when the foot of the perpendicular from p onto the side's plane lies within the side.
bool footInside(const Vec3& p, const Side& s, const Vec3& normal) {
  const Vec3 inEdge = glm::cross(normal, s.b - s.a);
  const double outward = glm::dot(inEdge, s.da) >= 0.0 ? 1.0 : -1.0;
  if (outward * glm::dot(inEdge, p - s.a) < 0.0) return false;
  const Vec3 inA = glm::cross(normal, s.da), inB = glm::cross(normal, s.db);
  const double towardsB = glm::dot(inA, s.b - s.a) >= 0.0 ? 1.0 : -1.0;
  return towardsB * glm::dot(inA, p - s.a) >= 0.0 && towardsB * glm::dot(inB, p - s.b) <= 0.0;
}

bool isWithin(const Vec3& p, const Side& s, double threshold) {
  const Vec3 normal = glm::cross(s.b - s.a, s.da);
  const double length = glm::length(normal);
  if (length > 0.0) {
    const double height = glm::dot(normal, p - s.a) / length;
    if (std::abs(height) > threshold) return false;
    if (footInside(p, s, normal)) return true;
  }
  const double limit = threshold * threshold;
  return squaredToSegment(p, s.a, s.b) <= limit || squaredToRay(p, s.a, s.da) <= limit ||
         squaredToRay(p, s.b, s.db) <= limit;
}

// True when p lies on the triangle or nearly so: such an eye sees both into the shadow and past it, and the cap between is not drawn.
bool isOnCaster(const Vec3& p, const CasterSet& casters, std::uint32_t triangle, double threshold) {
  const Vec3 a = casters.corner(triangle, 0), b = casters.corner(triangle, 1), c = casters.corner(triangle, 2);
  const Vec3 outside = glm::max(glm::min(a, glm::min(b, c)) - p, p - glm::max(a, glm::max(b, c)));
  return std::max({outside.x, outside.y, outside.z}) <= threshold && distanceToTriangle(p, a, b, c) <= threshold;
}

// Off by irrational-looking fractions, so that an eye on a lattice leaves all its planes.
constexpr std::array<std::array<double, 3>, 6> kDetours{{{0.5411, 0.3301, 0.7727},
                                                         {-0.6151, 0.7019, 0.3589},
                                                         {0.2113, -0.8297, 0.5167},
                                                         {0.3967, 0.6277, -0.6701},
                                                         {-0.7603, -0.2897, -0.5813},
                                                         {0.8831, -0.1867, -0.4327}}};

// The count is constant as long as no side and no caster is crossed, and the eye is at least the threshold away from every
// side that counts. So where the segment to the light grazes an inner edge or corner of a caster, ask from a point beside.
std::vector<std::uint32_t> certainlyCrossed(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye,
                                            const EyeCount& plan) {
  CrossedSurfaces result = crossedSurfaces(casters, silhouette, eye, plan.byZFail);
  for (std::size_t i = 0; result.unclear > 0 && i < kDetours.size(); ++i) {
    const Vec3 detour(kDetours[i][0], kDetours[i][1], kDetours[i][2]);
    result = crossedSurfaces(casters, silhouette, eye + 1e-4 * plan.threshold * detour, plan.byZFail);
  }
  return std::move(result.triangles);
}

}  // namespace

double eyeThreshold(const CasterSet& casters, const Vec4& light, const Vec3& eye) {
  const Vec3 e = glm::abs(eye);
  const double ulp = std::numeric_limits<float>::epsilon() * std::max({e.x, e.y, e.z});
  double reach = casters.bounds.radius();
  if (light.w != 0.0) reach = std::max(reach, glm::length(eye - Vec3(light) / light.w));
  return std::max(kRelativeThreshold * reach, 16.0 * ulp);
}

std::vector<std::uint8_t> sidesAtEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye) {
  const double threshold = eyeThreshold(casters, silhouette.light, eye);
  std::vector<std::uint8_t> touched(casters.componentCount, 0);
  for (const SilhouetteEdge& edge : silhouette.edges) {
    if (touched[edge.component] != 0) continue;
    const Side side = sideOf(casters.position(edge.a), casters.position(edge.b), silhouette.light);
    if (isWithin(eye, side, threshold)) touched[edge.component] = 1;
  }
  return touched;
}

// A point of a side within the threshold of the eye lies on the way from the light through a point of the box; carried back along
// it together, the eye comes to a point of its own way to the light, and the two are no farther apart than before.
std::vector<std::uint8_t> boxesBetween(const CasterSet& casters, const Vec4& light, const Vec3& eye) {
  const double threshold = (1.0 + 1e-9) * eyeThreshold(casters, light, eye);
  std::vector<std::uint8_t> between(casters.componentCount, 0);
  for (std::uint32_t c = 0; c < casters.componentCount; ++c)
    between[c] = meetsWay(casters.componentBounds[c], threshold, eye, light) ? 1 : 0;
  return between;
}

bool liesOnSide(const CasterSet& casters, const SilhouetteEdge& edge, const Vec4& light, const Vec3& eye) {
  const Vec3 a = casters.position(edge.a), b = casters.position(edge.b);
  // Of what is farther from the eye than a corner, a side this near hides less than a thousandth of a pixel.
  const double threshold = 0x1p-22 * std::max(glm::length(a - eye), glm::length(b - eye));
  return isWithin(eye, sideOf(a, b, light), threshold);
}

EyeCount touchesEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye) {
  EyeCount plan;
  plan.threshold = eyeThreshold(casters, silhouette.light, eye);
  plan.byZFail = sidesAtEye(casters, silhouette, eye);
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
    if (silhouette.side[t] != 0 && plan.byZFail[casters.componentOf[t]] == 0 &&
        isOnCaster(eye, casters, t, plan.threshold))
      plan.byZFail[casters.componentOf[t]] = 1;
  plan.byZFailCount = static_cast<std::size_t>(std::count(plan.byZFail.begin(), plan.byZFail.end(), 1));
  return plan;
}

EyeCount countAtEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye) {
  EyeCount plan = touchesEye(casters, silhouette, eye);
  plan.crossed = certainlyCrossed(casters, silhouette, eye, plan);
  plan.count = static_cast<int>(plan.crossed.size());
  return plan;
}

EyeCount chooseAtEye(const CasterSet& casters, const Silhouette& silhouette, const Vec3& eye) {
  EyeCount plan;
  plan.threshold = eyeThreshold(casters, silhouette.light, eye);
  plan.byZFail = sidesAtEye(casters, silhouette, eye);
  const std::vector<std::uint8_t> between = boxesBetween(casters, silhouette.light, eye);
  for (std::uint32_t c = 0; c < casters.componentCount; ++c) plan.byZFail[c] |= between[c];
  plan.byZFailCount = static_cast<std::size_t>(std::count(plan.byZFail.begin(), plan.byZFail.end(), 1));
  return plan;
}

}  // namespace umbrage::shadow
