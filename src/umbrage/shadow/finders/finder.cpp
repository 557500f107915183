#include "umbrage/shadow/finders/finder.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/shadow/finders/automatic.hpp"
#include "umbrage/shadow/finders/brute_force.hpp"
#include "umbrage/shadow/finders/hextree.hpp"
#include "umbrage/shadow/finders/hough.hpp"
#include "umbrage/shadow/finders/potentially_visible.hpp"

namespace umbrage::shadow {
namespace {

constexpr std::array kKinds{FinderKind::automatic, FinderKind::bruteForce, FinderKind::bruteForceSimd,
                            FinderKind::hextree,   FinderKind::hough,      FinderKind::potentiallyVisible,
                            FinderKind::gpu};
constexpr std::array<std::string_view, 7> kNames{
    "auto", "brute_force", "brute_force_simd", "hextree", "hough", "potentially_visible", "gpu"};

}  // namespace

std::span<const FinderKind> finderKinds() { return std::span(kKinds).first(kKinds.size() - 1); }

std::span<const FinderKind> allFinderKinds() { return kKinds; }

std::string_view name(FinderKind kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<FinderKind> finderNamed(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return kKinds[static_cast<std::size_t>(found - kNames.begin())];
}

Silhouette SilhouetteFinder::silhouette(const Vec4& light, const SilhouetteOptions& options) const {
  return assemble(casters(), light, find(light, options), findSides(casters(), light, options));
}

std::unique_ptr<SilhouetteFinder> makeFinder(FinderKind kind, std::shared_ptr<const CasterSet> casters,
                                             const FinderOptions& options) {
  UMBRAGE_CHECK(casters != nullptr, "casters");
  switch (kind) {
    case FinderKind::bruteForce: return std::make_unique<BruteForce>(std::move(casters));
    case FinderKind::bruteForceSimd: return std::make_unique<BruteForceSimd>(std::move(casters), options);
    case FinderKind::hextree: return std::make_unique<Hextree>(std::move(casters), options);
    case FinderKind::hough: return std::make_unique<Hough>(std::move(casters), options);
    case FinderKind::potentiallyVisible: return std::make_unique<PotentiallyVisible>(std::move(casters), options);
    case FinderKind::automatic: return std::make_unique<Automatic>(std::move(casters), options);
    case FinderKind::gpu: break;
  }
  UMBRAGE_CHECK(false, "a finder of the processor");
  return nullptr;
}

Vec4 intoObjectSpace(const Mat4& objectToWorld, const Vec4& light) {
  const Vec3 from = Vec3(light) - Vec3(objectToWorld[3]) * light.w;
  return {glm::dot(Vec3(objectToWorld[0]), from), glm::dot(Vec3(objectToWorld[1]), from),
          glm::dot(Vec3(objectToWorld[2]), from), light.w};
}

Silhouette assemble(const CasterSet& casters, const Vec4& light, const FoundEdges& found,
                    std::vector<std::int8_t> side) {
  Silhouette silhouette{light, std::move(side), {}, found.tested, name(found.answeredBy)};
  silhouette.edges.reserve(found.edges.size());
  for (const SignedEdge& e : found.edges) {
    const CasterEdge& edge = casters.edges[e.edge];
    silhouette.edges.push_back(
        {edge.a, edge.b, e.multiplicity, casters.componentOf[casters.uses[edge.begin].triangle]});
  }
  return silhouette;
}

}  // namespace umbrage::shadow
