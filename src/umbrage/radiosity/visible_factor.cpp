#include "umbrage/radiosity/visible_factor.hpp"

#include <algorithm>
#include <bit>

#include "umbrage/radiosity/form_factor.hpp"

namespace umbrage::radiosity {
namespace {

using Corners = std::array<Vec3, 3>;

constexpr double kLiftResolutions = 4.0;
/// Less of the light is none.
constexpr double kNothing = 1e-12;
/// Rays near corners aim so far inside, lest they meet what stands at the border.
constexpr double kInside = 0.05;
/// Below this depth no agreement of rays is trusted where the factor is large.
constexpr int kForced = 3;

struct Query {
  const trace::Occlusion& occlusion;
  const Receiver& receiver;
  const Emitter& emitter;
  const VisibilityAccuracy& accuracy;
};

/// Of the rays to a piece: first one to each of its quarters, then those to its corners.
struct Seen {
  std::uint32_t asked = 0, hidden = 0;
};
constexpr std::uint32_t kQuarters = 0xfu;

std::array<Corners, 4> quarters(const Corners& c) {
  const Vec3 a = 0.5 * (c[1] + c[2]), b = 0.5 * (c[2] + c[0]), d = 0.5 * (c[0] + c[1]);
  return {Corners{c[0], d, b}, Corners{d, c[1], a}, Corners{b, a, c[2]}, Corners{a, b, d}};
}

/// Random numbers that are the same for the same two points. Source: G. Steele, D. Lea and C. Flood, SplitMix, 2014.
class Random {
 public:
  Random(const Vec3& a, const Vec3& b) {
    for (int k = 0; k < 3; ++k) {
      state_ = (state_ ^ std::bit_cast<std::uint64_t>(a[k])) * 0x9e3779b97f4a7c15u;
      state_ = (state_ ^ (state_ >> 29) ^ std::bit_cast<std::uint64_t>(b[k])) * 0xbf58476d1ce4e5b9u;
    }
  }
  double unit() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return double((z ^ z >> 31) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 0;
};

// Shadows in buildings run along the edges of what they fall on. Rays to the same places of every quarter would miss them all alike.
std::array<Vec3, 7> targets(const Vec3& from, const Corners& c) {
  const Vec3 middle = (c[0] + c[1] + c[2]) / 3.0;
  Random random(from, middle);
  std::array<Vec3, 7> points;
  const auto parts = quarters(c);
  for (std::size_t k = 0; k < 4; ++k) {
    double u = random.unit(), v = random.unit();
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    points[k] = parts[k][0] + u * (parts[k][1] - parts[k][0]) + v * (parts[k][2] - parts[k][0]);
  }
  for (std::size_t k = 0; k < 3; ++k) points[4 + k] = c[k] + kInside * (middle - c[k]);
  return points;
}

Seen look(const Query& q, const Corners& piece) {
  const Vec3 from = q.receiver.point + q.receiver.lift * q.receiver.normal;
  trace::Rays8 rays{};
  const auto points = targets(q.receiver.point, piece);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (glm::dot(points[k] - q.receiver.point, q.receiver.normal) <= 0.0) continue;  // below the horizon
    const Vec3 along = points[k] + q.emitter.lift * q.emitter.normal - from;
    rays.fromX[k] = static_cast<float>(from.x), rays.fromY[k] = static_cast<float>(from.y);
    rays.fromZ[k] = static_cast<float>(from.z);
    rays.directionX[k] = static_cast<float>(along.x), rays.directionY[k] = static_cast<float>(along.y);
    rays.directionZ[k] = static_cast<float>(along.z);
    rays.length[k] = 1.0f;
    rays.active |= 1u << k;
  }
  return {rays.active, rays.active != 0 ? q.occlusion.meetsCaster(rays) : 0};
}

double visible(const Query& q, const Corners& piece, int depth) {
  const double whole = polygonFactor(q.receiver.point, q.receiver.normal, piece);
  if (whole <= kNothing) return 0.0;
  const Seen seen = look(q, piece);
  const bool agreed = seen.asked != 0 && (seen.hidden == 0 || seen.hidden == seen.asked);
  if (agreed && (whole <= q.accuracy.coarse || depth >= kForced)) return seen.hidden == 0 ? whole : 0.0;
  if (whole <= q.accuracy.fine || depth >= q.accuracy.depth) {
    const std::uint32_t counted = (seen.asked & kQuarters) != 0 ? seen.asked & kQuarters : seen.asked;
    if (counted == 0) return 0.0;
    return whole * double(std::popcount(counted & ~seen.hidden)) / double(std::popcount(counted));
  }
  double sum = 0.0;
  for (const Corners& quarter : quarters(piece)) sum += visible(q, quarter, depth + 1);
  return sum;
}

}  // namespace

double liftOf(const trace::Occlusion& occlusion, std::uint32_t triangle, const Vec3& point) {
  const bool casts = occlusion.surfaces().casts[triangle] != 0;
  const double reach = std::max(trace::largest(point), casts ? double(occlusion.reach(triangle)) : 0.0);
  return kLiftResolutions * trace::resolution(reach);
}

double visibleFactor(const trace::Occlusion& occlusion, const Receiver& receiver, const Emitter& emitter,
                     const VisibilityAccuracy& accuracy) {
  // Who lies in the emitter's plane sees nothing of it.
  const Vec3 away = receiver.point - emitter.corner[0];
  if (glm::dot(away, emitter.normal) <= 1e-9 * glm::length(away)) return 0.0;
  return visible({occlusion, receiver, emitter, accuracy}, emitter.corner, 0);
}

}  // namespace umbrage::radiosity
