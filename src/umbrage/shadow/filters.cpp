#include "umbrage/shadow/filters.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::shadow {
namespace {

constexpr double kDarkest = 0x1p-14;
constexpr double kMostSurfaces = 4000.0;
constexpr double kFinest = 0x1p24;

bool isVeil(const scene::Material& material) {
  const Vec3 part = scene::transmittance(material);
  return std::max({part.x, part.y, part.z}) >= kDarkest;
}

// What the darkest channel of a veil takes, as -log2; nothing of what is none.
double mostTaken(const scene::Material& material) {
  const Vec3 part = scene::transmittance(material);
  return isVeil(material) ? -std::log2(std::clamp(std::min({part.x, part.y, part.z}), kDarkest, 1.0)) : 0.0;
}

// The most that a way can take up: of kMostSurfaces of the darkest, or of every triangle once, where that is less.
double mostTaken(const scene::Surfaces& surfaces, const std::vector<scene::Material>& materials) {
  std::vector<double> taken;
  for (const scene::Material& material : materials) taken.push_back(mostTaken(material));
  double all = 0.0, darkest = 0.0;
  for (const std::uint32_t material : surfaces.materials)
    all += taken[material], darkest = std::max(darkest, taken[material]);
  return std::min(all, kMostSurfaces * darkest);
}

// So fine that `most` fits into 31 bits.
double stepsFor(double most) {
  constexpr double kRoom = 0x1p31 - 0x1p16;  // each surface is rounded to whole steps
  return most > 0.0 ? std::min(kFinest, std::exp2(std::floor(std::log2(kRoom / most)))) : kFinest;
}

}  // namespace

Filters::Filters(const scene::Surfaces& surfaces, const std::vector<scene::Material>& materials)
    : steps_(stepsFor(mostTaken(surfaces, materials))) {
  const auto taken = [&](double part) {
    return static_cast<std::int32_t>(std::lround(-steps_ * std::log2(std::clamp(part, kDarkest, 1.0))));
  };
  std::vector<std::uint32_t> ofMaterial;
  for (const scene::Material& material : materials) {
    const Vec3 part = scene::transmittance(material);
    ofMaterial.push_back(shadow::isVeil(material) ? static_cast<std::uint32_t>(sums_.size()) : 0);
    if (ofMaterial.back() != 0) sums_.push_back({taken(part.x), taken(part.y), taken(part.z)});
  }
  const auto veiled = [&](std::uint32_t material) { return ofMaterial[material] != 0; };
  if (std::none_of(surfaces.materials.begin(), surfaces.materials.end(), veiled)) return;
  for (const std::uint32_t material : surfaces.materials) ofTriangle_.push_back(ofMaterial[material]);
}

Vec3f Filters::transmitted(const FilterSum& sum) const {
  const auto part = [&](std::int32_t taken) { return static_cast<float>(std::exp2(-double(taken) / steps_)); };
  return {part(sum[0]), part(sum[1]), part(sum[2])};
}

}  // namespace umbrage::shadow
