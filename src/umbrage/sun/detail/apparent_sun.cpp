#include "umbrage/sun/detail/apparent_sun.hpp"

#include <erfa.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "umbrage/sun/detail/julian_date.hpp"

namespace umbrage::sun::detail {
namespace {

constexpr double kEpoch = 2451545.0;  // Julian date of 2000-01-01 12:00 TT

// The fastest of what moves the sun's place, nutation by the moon, has periods of days: a polynomial of degree 7 over four days
// is within 1e-12 radians of it.
constexpr double kBlockDays = 4.0;
constexpr int kNodes = 8;
constexpr std::array<double, kNodes> kNodeTimes{0.0, 0.3, 0.9, 1.6, 2.4, 3.1, 3.7, 4.0};

// The weights of barycentric interpolation between kNodeTimes.
constexpr std::array<double, kNodes> weights() {
  std::array<double, kNodes> w{};
  for (int i = 0; i < kNodes; ++i) {
    w[i] = 1.0;
    for (int k = 0; k < kNodes; ++k)
      if (k != i) w[i] /= kNodeTimes[i] - kNodeTimes[k];
  }
  return w;
}
constexpr std::array<double, kNodes> kWeights = weights();

struct Block {
  std::int64_t index = std::numeric_limits<std::int64_t>::min();
  std::array<Vec3, kNodes> suns;
};

Block blockOf(std::int64_t index) {
  Block block{index, {}};
  for (int i = 0; i < kNodes; ++i) block.suns[i] = apparentSunBySeries(double(index) * kBlockDays, kNodeTimes[i]);
  return block;
}

// Blocks that this thread has asked for; a year's fit.
const Block& remembered(std::int64_t index) {
  constexpr std::int64_t kRemembered = 128;
  thread_local std::array<Block, kRemembered> blocks;
  Block& block = blocks[static_cast<std::size_t>(((index % kRemembered) + kRemembered) % kRemembered)];
  if (block.index != index) block = blockOf(index);
  return block;
}

Vec3 interpolate(const Block& block, double time) {
  Vec3 sum(0.0);
  double divisor = 0.0;
  for (int i = 0; i < kNodes; ++i) {
    const double apart = time - kNodeTimes[i];
    if (apart == 0.0) return block.suns[i];
    const double weight = kWeights[i] / apart;
    sum += weight * block.suns[i];
    divisor += weight;
  }
  return sum / divisor;
}

}  // namespace

Vec3 apparentSunBySeries(double wholeDays, double fraction) {
  const double day = kEpoch + wholeDays;
  eraASTROM frame;
  double equationOfOrigins;
  eraApci13(day, fraction, &frame, &equationOfOrigins);
  double heliocentric[2][3], barycentric[2][3];
  eraEpv00(day, fraction, heliocentric, barycentric);
  double towards[3], distance, direction[3];
  eraSxp(-1.0, heliocentric[0], towards);
  eraPn(towards, &distance, direction);
  // The sun hardly moves about the barycentre while its light travels, so aberration alone accounts for the light time.
  double apparent[3], intermediate[3];
  eraAb(direction, frame.v, distance, frame.bm1, apparent);
  eraRxp(frame.bpn, apparent, intermediate);
  return distance * Vec3(intermediate[0], intermediate[1], intermediate[2]);
}

Vec3 apparentSun(Instant instant) {
  const JulianDate utc = julianDate(instant);
  // Terrestrial time runs on where clocks have leap seconds, so nothing jumps within a block.
  const double whole = utc.day - (kEpoch - 0.5), part = utc.fraction - 0.5 + ttMinusUtc(instant) / 86400.0;
  const auto index = static_cast<std::int64_t>(std::floor((whole + part) / kBlockDays));
  return interpolate(remembered(index), (whole - double(index) * kBlockDays) + part);
}

}  // namespace umbrage::sun::detail
