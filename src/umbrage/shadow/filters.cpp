#include "umbrage/shadow/filters.hpp"

#include <algorithm>
#include <cmath>

namespace umbrage::shadow {
namespace {

constexpr double kSteps = 0x1p17;  // to a factor of 2
constexpr double kDarkest = 0x1p-14;

std::int32_t taken(double part) {
  return static_cast<std::int32_t>(std::lround(-kSteps * std::log2(std::clamp(part, kDarkest, 1.0))));
}

}  // namespace

Filters::Filters(const scene::Surfaces& surfaces, const std::vector<scene::Material>& materials) {
  std::vector<std::uint32_t> ofMaterial;
  for (const scene::Material& material : materials) {
    const Vec3 part = scene::transmittance(material);
    const bool isVeil = std::max({part.x, part.y, part.z}) >= kDarkest;
    ofMaterial.push_back(isVeil ? static_cast<std::uint32_t>(sums_.size()) : 0);
    if (isVeil) sums_.push_back({taken(part.x), taken(part.y), taken(part.z)});
  }
  const auto veiled = [&](std::uint32_t material) { return ofMaterial[material] != 0; };
  if (std::none_of(surfaces.materials.begin(), surfaces.materials.end(), veiled)) return;
  for (const std::uint32_t material : surfaces.materials) ofTriangle_.push_back(ofMaterial[material]);
}

Vec3f transmitted(const FilterSum& sum) {
  constexpr auto kStep = static_cast<float>(1.0 / kSteps);
  return {std::exp2(-kStep * static_cast<float>(sum[0])), std::exp2(-kStep * static_cast<float>(sum[1])),
          std::exp2(-kStep * static_cast<float>(sum[2]))};
}

}  // namespace umbrage::shadow
