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

// What the darkest channel of all veils takes, as -log2.
double mostTaken(const std::vector<scene::Material>& materials) {
  double most = 0.0;
  for (const scene::Material& material : materials) {
    const Vec3 part = scene::transmittance(material);
    if (isVeil(material)) most = std::max(most, -std::log2(std::max(kDarkest, std::min({part.x, part.y, part.z}))));
  }
  return most;
}

double stepsFor(double most) {
  if (!(most > 0.0)) return kFinest;
  return std::min(kFinest, std::exp2(std::floor(std::log2(0x1p31 / (kMostSurfaces * most)))));
}

}  // namespace

Filters::Filters(const scene::Surfaces& surfaces, const std::vector<scene::Material>& materials)
    : steps_(stepsFor(mostTaken(materials))) {
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
