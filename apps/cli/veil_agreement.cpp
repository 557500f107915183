#include "veil_agreement.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/shadow/true_edges.hpp"

namespace umbrage::cli {
namespace {

constexpr std::size_t kMostLookedAt = 256;  // light with more suspicious veils is simply wrong
constexpr int kSamples = 32;                // a pixel, along each axis
constexpr double kSnap = 0x1p-8;            // pixels to which rasterisers snap corners
constexpr int kSnapSamples = 16;
// Relative: so much depth changes within the snapping, where it is seen at a grazing angle.
constexpr float kSameDepth = 0x1p-12f;

bool differ(const shadow::Tint& a, const shadow::Tint& b) {
  const Vec3 apart = glm::abs(shadow::partsOf(a) - shadow::partsOf(b));
  return std::max({apart.x, apart.y, apart.z}) > 1.0 / 255.0;
}

/// The veils of one pixel and their light.
struct Lit {
  std::span<const shadow::Veil> veils;
  std::span<const shadow::Tint> light;
};
Lit litAt(const shadow::Shading& shading, std::size_t light, std::size_t pixel) {
  const auto veils = shading.veils.at(pixel);
  if (veils.empty()) return {};
  return {veils, std::span(shading.masks[light].veils).subspan(shading.veils.first[pixel], veils.size())};
}

/// Whether one of two neighbours has an edge on its k-th veil, or none.
bool edgeBetween(const Lit& a, const Lit& b, std::size_t k) {
  return a.veils.size() != b.veils.size() || (k < a.veils.size() && differ(a.light[k], b.light[k]));
}

// Which of two neighbours shows at their common edge is left to rounding.
bool shownAlike(const Lit& a, const Lit& b) {
  return std::ranges::equal(a.veils, b.veils, [](const shadow::Veil& v, const shadow::Veil& w) {
    return v.triangle == w.triangle || std::abs(v.depth - w.depth) <= kSameDepth * w.depth;
  });
}

struct Suspect {
  int x, y;
  std::size_t veil;
};

/// What differs and has no edge near that single samples show.
class Search {
 public:
  Search(const shadow::Shading& reference, std::size_t light, const scene::Camera& camera, int tolerance)
      : reference_(reference), light_(light), camera_(camera), tolerance_(tolerance) {}

  void lookAt(int x, int y, const Lit& mine, VeilAgreement& agreement, std::vector<Suspect>& suspects) const {
    const Lit theirs = at(x, y);
    agreement.veils += theirs.veils.size();
    if (!shownAlike(mine, theirs)) {
      agreement.differing += std::max(mine.veils.size(), theirs.veils.size());
      for (std::size_t k = 0; k < std::max(mine.veils.size(), theirs.veils.size()); ++k)
        if (!edgeNear(x, y, k)) suspects.push_back({x, y, k});
      return;
    }
    for (std::size_t k = 0; k < mine.veils.size(); ++k) {
      if (!differ(mine.light[k], theirs.light[k])) continue;
      ++agreement.differing;
      if (!edgeNear(x, y, k)) suspects.push_back({x, y, k});
    }
  }

 private:
  [[nodiscard]] Lit at(int x, int y) const {
    return litAt(reference_, light_,
                 static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) + static_cast<std::size_t>(x));
  }
  [[nodiscard]] bool edgeNear(int x, int y, std::size_t k) const {
    const Lit here = at(x, y);
    for (int v = std::max(0, y - tolerance_); v <= std::min(camera_.height - 1, y + tolerance_); ++v)
      for (int u = std::max(0, x - tolerance_); u <= std::min(camera_.width - 1, x + tolerance_); ++u)
        if (edgeBetween(here, at(u, v), k)) return true;
    return false;
  }
  const shadow::Shading& reference_;
  std::size_t light_;
  const scene::Camera& camera_;
  int tolerance_;
};

// What is within the snapping of corners of a pixel's centre.
scene::Camera aroundCentre(const scene::Camera& camera, const Suspect& suspect) {
  scene::Camera fine = shadow::magnified(camera, suspect.x + 0.5, suspect.y + 0.5, 1);
  fine.fovY = Angle::radians(fine.fovY.radians() * 2.0 * kSnap / fine.height);
  fine.width = fine.height = kSnapSamples;
  return fine;
}

// fn(a, b) on the light of two samples: whether an edge lies between them.
template <class Fn>
Result<bool> samplesShow(const shadow::Frame& frame, const scene::Camera& camera, const scene::Light& light,
                         shadow::Technique& truth, const Fn& fn) {
  shadow::Frame fine = frame;
  fine.camera = camera;
  fine.lights = {&light, 1};
  const auto shading = truth.shade(fine);
  if (!shading) return tl::unexpected(shading.error());
  const Lit first = litAt(*shading, 0, 0);
  for (std::size_t pixel = 1; pixel < shading->surface.triangle.size(); ++pixel)
    if (fn(first, litAt(*shading, 0, pixel))) return true;
  return false;
}

// Beside a border of two filters a rasteriser shows one and may count the volume's side between them as it is before the other.
bool otherFilter(const Lit& a, const Lit& b, std::size_t last, const shadow::Filters& filters) {
  for (std::size_t k = 0; k <= last && k < std::min(a.veils.size(), b.veils.size()); ++k)
    if (filters.of(a.veils[k].triangle) != filters.of(b.veils[k].triangle)) return true;
  return false;
}

Result<bool> edgeThere(const shadow::Frame& frame, const scene::Light& light, const Suspect& suspect,
                       const shadow::Filters& filters, shadow::Technique& truth) {
  const auto edge = [&](const Lit& a, const Lit& b) { return edgeBetween(a, b, suspect.veil); };
  const scene::Camera wide = shadow::magnified(frame.camera, suspect.x + 0.5, suspect.y + 0.5, kSamples);
  if (const auto shown = samplesShow(frame, wide, light, truth, edge); !shown || *shown) return shown;
  return samplesShow(frame, aroundCentre(frame.camera, suspect), light, truth, [&](const Lit& a, const Lit& b) {
    return edge(a, b) || otherFilter(a, b, suspect.veil, filters);
  });
}

}  // namespace

Result<std::vector<VeilAgreement>> compareVeils(const shadow::Shading& mine, const shadow::Shading& reference,
                                                const shadow::Frame& frame, const shadow::Filters& filters,
                                                int tolerance, shadow::Technique& truth) {
  std::vector<VeilAgreement> lights;
  const auto width = static_cast<std::size_t>(frame.camera.width);
  for (std::size_t i = 0; i < reference.masks.size(); ++i) {
    VeilAgreement agreement;
    std::vector<Suspect> suspects;
    const Search search(reference, i, frame.camera, tolerance);
    for (int y = 0; y < frame.camera.height; ++y)
      for (int x = 0; x < frame.camera.width; ++x)
        search.lookAt(x, y, litAt(mine, i, static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)),
                      agreement, suspects);
    agreement.astray = suspects.size();
    for (std::size_t k = 0; k < suspects.size() && suspects.size() <= kMostLookedAt; ++k) {
      const auto edge = edgeThere(frame, frame.lights[i], suspects[k], filters, truth);
      if (!edge) return tl::unexpected(edge.error());
      if (*edge) --agreement.astray;
    }
    lights.push_back(agreement);
  }
  return lights;
}

}  // namespace umbrage::cli
