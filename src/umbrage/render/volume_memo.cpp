#include "umbrage/render/volume_memo.hpp"

#include <utility>

#include "umbrage/render/gpu_scene.hpp"
#include "umbrage/shadow/layering.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::render {
namespace {

constexpr std::size_t kTurnsKept = 64;

IndexRange append(std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& more) {
  const IndexRange range{indices.size(), more.size()};
  indices.insert(indices.end(), more.begin(), more.end());
  return range;
}

// Parts that share the stencil with others must leave it a bit.
std::vector<VolumePart> partsOf(const shadow::CasterSet& casters, shadow::Silhouette whole) {
  std::vector<VolumePart> parts;
  const int bound = shadow::layeringBound(casters, whole, kSharedStencil);
  if (bound <= kSharedStencil) {
    parts.push_back({.silhouette = std::move(whole), .layers = bound});
    return parts;
  }
  const shadow::LayerGroups groups = shadow::groupLayers(casters, whole, kSharedStencil);
  for (int g = 0; g < groups.count; ++g)
    parts.push_back({.silhouette = shadow::restrictTo(casters, whole, groups, g), .layers = kSharedStencil});
  return parts;
}

Result<StoredVolume> makeVolume(const shadow::SilhouetteFinder& finder, const Vec4& light, bool endsAnywhere) {
  const shadow::CasterSet& casters = finder.casters();
  StoredVolume volume;
  shadow::Silhouette whole = finder.silhouette(light);
  volume.stats.finder = whole.finder;
  volume.stats.edgesTested = whole.edgesTested;
  volume.stats.silhouetteEdges = whole.edges.size();
  volume.parts = partsOf(casters, std::move(whole));
  std::vector<std::uint32_t> indices;
  for (VolumePart& part : volume.parts) {
    const shadow::ShadowVolume extruded = shadow::extrude(casters, part.silhouette, {.endsAnywhere = endsAnywhere});
    part.indicesPerSide = light.w == 0.0 && !endsAnywhere ? 3 : 6;
    part.sides = append(indices, extruded.sides);
    part.caps = append(indices, extruded.caps);
  }
  volume.stats.volumeTriangles = indices.size() / 3;
  if (auto done = volume.indices.setAll(indices); !done) return tl::unexpected(done.error());
  return volume;
}

}  // namespace

void VolumeMemo::beginTurn() {
  ++turn_;
  std::erase_if(entries_, [](const auto& entry) { return entry.second.casters.expired(); });
  for (auto& [casters, entry] : entries_)
    std::erase_if(entry.volumes, [&](const auto& volume) { return volume.second.lastUsed + kTurnsKept < turn_; });
}

Result<VolumeMemo::Entry*> VolumeMemo::entryOf(const Casters& casters) {
  const auto found = entries_.find(casters.get());
  // Other casters may have come to live at the address of some that are gone.
  if (found != entries_.end() && !found->second.casters.expired()) return &found->second;
  Entry entry{casters, {}, nullptr, {}};
  const std::shared_ptr<const shadow::CasterSet> borrowed(std::shared_ptr<void>(), casters.get());
  entry.finder = shadow::makeFinder(shadow::FinderKind::automatic, borrowed);
  if (auto done = setStorage(entry.positions, std::as_bytes(std::span(casters->positions)), "positions"); !done)
    return tl::unexpected(done.error());
  ++work_.uploads;
  return &entries_.insert_or_assign(casters.get(), std::move(entry)).first->second;
}

Result<const gl::Buffer*> VolumeMemo::positions(const Casters& casters) {
  const auto entry = entryOf(casters);
  if (!entry) return tl::unexpected(entry.error());
  return &(*entry)->positions;
}

Result<const StoredVolume*> VolumeMemo::volume(const Casters& casters, const Vec4& light, bool endsAnywhere) {
  const auto entry = entryOf(casters);
  if (!entry) return tl::unexpected(entry.error());
  auto& volumes = (*entry)->volumes;
  const std::array<double, 5> key{light.x, light.y, light.z, light.w, endsAnywhere ? 1.0 : 0.0};
  auto found = volumes.find(key);
  if (found == volumes.end()) {
    auto made = makeVolume(*(*entry)->finder, light, endsAnywhere);
    if (!made) return tl::unexpected(made.error());
    ++work_.silhouettes;
    found = volumes.emplace(key, std::move(*made)).first;
  } else if (found->second.lastUsed != turn_) {
    ++work_.reused;
  }
  found->second.lastUsed = turn_;
  return &found->second;
}

}  // namespace umbrage::render
