#include "umbrage/techniques/cpu/detail/soft_mean.hpp"

#include <cmath>
#include <limits>

#include "umbrage/parallel/for_each.hpp"

namespace umbrage::techniques::detail {
namespace {

/// So much of a light is none, or all, whatever rounding left of it.
constexpr float kNone = 0.5f / 65535.0f;

float luminance(const Vec3f& light) { return 0.2126f * light.x + 0.7152f * light.y + 0.0722f * light.z; }

Vec3f partsAt(const shadow::LightMask& mask, std::size_t pixel) {
  if (mask.tint.empty()) return Vec3f(mask.light.pixels()[pixel] != 0 ? 1.0f : 0.0f);
  return Vec3f(shadow::partsOf(mask.tint.pixels()[pixel]));
}

}  // namespace

SoftMean::SoftMean(const scene::Camera& camera, const shadow::Shading& seen)
    : camera_(camera), rays_(scene::pixelRays(camera)), seen_(seen) {}

Result<void> SoftMean::add(std::span<const shadow::LightSample> samples, std::span<const shadow::LightMask> masks) {
  UMBRAGE_CHECK(samples.size() == masks.size() && !masks.empty(), "one mask a sample");
  const std::size_t count = seen_.surface.triangle.size() + seen_.veils.veils.size();
  if (samples_ == 0) {
    tinted_ = !masks[0].tint.empty();
    covered_ = masks[0].covered;
    for (Half& half : halves_) {
      half.light.assign(count, Vec3f(0.0f));
      if (samples[0].ball) half.weight.assign(count, 0.0f);
    }
  }
  auto done = parallel::forEach(camera_.height, [&](int y) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      addTo(halves_[shadow::halfOf(samples_ + i)], samples[i], masks[i], y);
  });
  for (std::size_t i = 0; i < samples.size(); ++i) ++halves_[shadow::halfOf(samples_ + i)].samples;
  samples_ += samples.size();
  return done;
}

void SoftMean::addTo(Half& half, const shadow::LightSample& sample, const shadow::LightMask& mask, int y) const {
  const std::size_t pixels = seen_.surface.triangle.size();
  for (int x = 0; x < camera_.width; ++x) {
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) + static_cast<std::size_t>(x);
    if (covered_.pixels()[pixel] != 0)
      addAt(half, pixel, partsAt(mask, pixel), sample, x, y, seen_.surface.depth.pixels()[pixel]);
    const auto veils = seen_.veils.at(pixel);
    for (std::size_t k = 0; k < veils.size(); ++k) {
      const std::size_t veil = seen_.veils.first[pixel] + k;
      addAt(half, pixels + veil, Vec3f(shadow::partsOf(mask.veils[veil])), sample, x, y, veils[k].depth);
    }
  }
}

void SoftMean::addAt(Half& half, std::size_t place, const Vec3f& light, const shadow::LightSample& sample, int x, int y,
                     double depth) const {
  if (half.weight.empty()) {
    half.light[place] += light;
    return;
  }
  const Vec3 point = camera_.eye + depth * rays_.through(x + 0.5, y + 0.5);
  const auto weight = static_cast<float>(sample.weight(point));
  half.light[place] += weight * light;
  half.weight[place] += weight;
}

float SoftMean::weightAt(const Half& half, std::size_t place) const {
  return half.weight.empty() ? static_cast<float>(half.samples) : half.weight[place];
}

Vec3f SoftMean::meanAt(std::size_t place) const {
  const float weight = weightAt(halves_[0], place) + weightAt(halves_[1], place);
  return weight > 0.0f ? (halves_[0].light[place] + halves_[1].light[place]) / weight : Vec3f(0.0f);
}

double SoftMean::error() const {
  if (halves_[1].samples == 0) return std::numeric_limits<double>::infinity();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t place = 0; place < halves_[0].light.size(); ++place) {
    if (place < covered_.size() && covered_.pixels()[place] == 0) continue;
    ++count;
    const float a = weightAt(halves_[0], place), b = weightAt(halves_[1], place);
    if (!(a > 0.0f && b > 0.0f)) continue;
    const double apart = luminance(halves_[0].light[place] / a - halves_[1].light[place] / b) / 2.0;
    sum += apart * apart;
  }
  return count > 0 ? std::sqrt(sum / double(count)) : 0.0;
}

shadow::LightMask SoftMean::mask() const {
  shadow::LightMask out{{camera_.width, camera_.height}, {}, covered_, {}};
  if (tinted_) out.tint = {camera_.width, camera_.height};
  for (std::size_t pixel = 0; pixel < covered_.size(); ++pixel) {
    const Vec3f mean = meanAt(pixel);
    const shadow::Tint tint = shadow::tintOf(mean);
    out.light.pixels()[pixel] = shadow::luminanceCode(tint);
    if (tinted_) out.tint.pixels()[pixel] = tint;
  }
  for (std::size_t place = covered_.size(); place < halves_[0].light.size(); ++place)
    out.veils.push_back(shadow::tintOf(meanAt(place)));
  return out;
}

shadow::SoftStats SoftMean::stats() const {
  shadow::SoftStats stats{samples_, error()};
  for (std::size_t pixel = 0; pixel < covered_.size(); ++pixel) {
    if (covered_.pixels()[pixel] == 0) continue;
    const float light = luminance(meanAt(pixel));
    if (light <= kNone)
      ++stats.umbra;
    else if (light < 1.0f - kNone)
      ++stats.penumbra;
  }
  return stats;
}

}  // namespace umbrage::techniques::detail
