#include "conformance/judge.hpp"

#include <algorithm>
#include <utility>

#include "support/asking.hpp"
#include "umbrage/shadow/unshadowed.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
#include "umbrage/techniques/gl/registry.hpp"
#endif

namespace umbrage::conformance {
namespace {

constexpr std::size_t kMostLookedAt = 256;  ///< a mask with more suspicious pixels than this is simply wrong

std::vector<std::pair<int, int>> farPixels(const shadow::LightMask& mask, const shadow::LightMask& truth,
                                           const image::GreyImage& edges, int tolerance) {
  std::vector<std::pair<int, int>> far;
  const auto edgeNear = [&](int x, int y) {
    for (int v = y - tolerance; v <= y + tolerance; ++v)
      for (int u = x - tolerance; u <= x + tolerance; ++u)
        if (edges.contains(u, v) && edges(u, v) != 0) return true;
    return false;
  };
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x)
      if (shadow::differAt(mask, truth, x, y) && !edgeNear(x, y)) far.emplace_back(x, y);
  return far;
}

}  // namespace

std::vector<shadow::TechniqueEntry> allTechniques() {
  // The soft ones show hard lights by others of these.
  auto all = techniques::cpuTechniques();
  std::erase_if(all, [](const shadow::TechniqueEntry& entry) { return entry.traits.soft; });
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
  for (auto& entry : techniques::openGlTechniques()) all.push_back(std::move(entry));
#endif
  // These promise nothing that could be judged; their own tests measure their error.
  std::erase_if(all, [](const shadow::TechniqueEntry& entry) { return entry.traits.approximate; });
  return all;
}

std::vector<shadow::TechniqueEntry> askedWays() {
  std::vector<shadow::TechniqueEntry> all;
  for (const shadow::TechniqueEntry& entry : allTechniques()) {
    if (entry.traits.name != "zfail" && entry.traits.name != "zpass") continue;
    all.push_back(support::asking(entry, entry.traits.name + " gpu",
                                  [](shadow::Frame& f) { f.silhouettes = shadow::FinderKind::gpu; }));
    all.push_back(support::asking(entry, entry.traits.name + " cpu",
                                  [](shadow::Frame& f) { f.extrusion = shadow::Extrusion::processor; }));
    all.push_back(support::asking(entry, entry.traits.name + " geom",
                                  [](shadow::Frame& f) { f.extrusion = shadow::Extrusion::geometryShader; }));
  }
  return all;
}

shadow::TechniqueEntry truthFor(const shadow::TechniqueEntry& entry, const shadow::Geometry& geometry) {
  const bool seesThrough = entry.traits.tinted && !geometry.filters.empty();
  for (const shadow::TechniqueEntry& truth : techniques::cpuTechniques())
    if (truth.traits.name == (seesThrough ? "transparent_rays" : "ray_traced")) return truth;
  UMBRAGE_CHECK(false, "the truth is missing");
}

Result<Judge> Judge::make(const shadow::TechniqueEntry& entry, std::shared_ptr<const shadow::Geometry> geometry) {
  Judge judge;
  judge.name_ = entry.traits.name;
  judge.tolerance_ = entry.traits.edgeTolerancePx;
  judge.geometry_ = std::move(geometry);
  auto technique = entry.create();
  auto truth = truthFor(entry, *judge.geometry_).create();
  if (!technique) return tl::unexpected(technique.error());
  if (!truth) return tl::unexpected(truth.error());
  judge.technique_ = std::move(*technique);
  judge.truth_ = std::move(*truth);
  if (auto done = judge.technique_->prepare(judge.geometry_); !done) return tl::unexpected(done.error());
  if (auto done = judge.truth_->prepare(judge.geometry_); !done) return tl::unexpected(done.error());
  judge.edges_ = std::make_unique<shadow::EdgeFinder>(judge.geometry_, judge.truth_);
  return judge;
}

Result<std::vector<Verdict>> Judge::judge(const NamedView& view, const std::vector<NamedLight>& named) {
  std::vector<scene::Light> lights;
  for (const NamedLight& n : named) lights.push_back(n.light);
  const auto shading = technique_->shade({view.camera, lights});
  if (!shading) return tl::unexpected(shading.error());
  const auto truth = truth_->shade({view.camera, lights});
  if (!truth) return tl::unexpected(truth.error());
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto edges = shadow::edgePixels(truth->masks[i]);
    const shadow::LightMask mask = shadow::whereKnown(shading->masks[i], shading->unshadowed, truth->masks[i]);
    Verdict v{name_, "", view.name, named[i].name, shadow::compare(mask, truth->masks[i], edges, tolerance_)};
    if (!shading->unshadowed.empty())
      v.difference.covered -= std::size_t(std::ranges::count(shading->unshadowed.pixels(), 1));
    for (const auto& [x, y] : farPixels(mask, truth->masks[i], edges, tolerance_)) {
      if (v.difference.farFromEdge > kMostLookedAt) break;
      const auto edge = edges_->edgeNear(view.camera, lights[i], x, y);
      if (!edge) return tl::unexpected(edge.error());
      if (*edge) --v.difference.farFromEdge;
    }
    verdicts.push_back(std::move(v));
  }
  return verdicts;
}

}  // namespace umbrage::conformance
