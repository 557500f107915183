#include "umbrage/render/prepare_light.hpp"

#include <utility>

#include "umbrage/shadow/layering.hpp"

namespace umbrage::render {
namespace {

IndexRange append(std::vector<std::uint32_t>& indices, std::vector<std::uint32_t>&& more) {
  const IndexRange range{indices.size(), more.size()};
  if (indices.empty())
    indices = std::move(more);
  else
    indices.insert(indices.end(), more.begin(), more.end());
  return range;
}

void addZFail(LightVolume& out, VolumeGroup& group, const shadow::CasterSet& casters,
              const shadow::Silhouette& silhouette, std::span<const std::uint8_t> components) {
  shadow::ShadowVolume volume = shadow::extrude(casters, silhouette, {.caps = true, .components = components});
  group.failSides = append(out.indices, std::move(volume.sides));
  group.failCaps = append(out.indices, std::move(volume.caps));
}

void addZPass(LightVolume& out, VolumeGroup& group, const shadow::CasterSet& casters,
              const shadow::Silhouette& silhouette, const shadow::EyeCount& atEye) {
  std::vector<std::uint8_t> others;
  if (atEye.byZFailCount > 0)
    for (const std::uint8_t fallen : atEye.byZFail) others.push_back(fallen == 0 ? 1 : 0);
  group.passSides =
      append(out.indices, shadow::extrude(casters, silhouette, {.caps = false, .components = others}).sides);
  if (atEye.byZFailCount > 0) addZFail(out, group, casters, silhouette, atEye.byZFail);
}

shadow::LayerGroups groupsFor(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette) {
  if (shadow::layeringBound(casters, silhouette, kWholeStencil) <= kWholeStencil) return {};
  return shadow::groupLayers(casters, silhouette, kSharedStencil);
}

}  // namespace

LightVolume prepareVolume(const shadow::SilhouetteFinder& finder, const Vec4& light, const Vec3& eye, Counting counting,
                          shadow::LightStats& stats, const PhaseEnd& ended) {
  const shadow::CasterSet& casters = finder.casters();
  const auto end = [&](const char* phase) {
    if (ended) ended(phase);
  };
  LightVolume out;
  out.light = light;
  out.counting = counting;
  const shadow::Silhouette whole = finder.silhouette(light);
  end("silhouette");
  const shadow::LayerGroups groups = groupsFor(casters, whole);
  end("layers");
  for (int g = 0; g < groups.count; ++g) {
    const shadow::Silhouette part =
        groups.count > 1 ? shadow::restrictTo(casters, whole, groups, g) : shadow::Silhouette{};
    const shadow::Silhouette& silhouette = groups.count > 1 ? part : whole;
    VolumeGroup group;
    if (counting == Counting::zPass) {
      const shadow::EyeCount atEye = shadow::countAtEye(casters, silhouette, eye);
      end("silhouette");
      addZPass(out, group, casters, silhouette, atEye);
      group.eyeCount = atEye.count;
      stats.castersByZFail += atEye.byZFailCount;
      stats.eyeCount += atEye.count;
    } else {
      addZFail(out, group, casters, silhouette, {});
    }
    end("extrude");
    out.groups.push_back(group);
  }
  stats.method = counting == Counting::zPass ? "zpass" : "zfail";
  stats.finder = whole.finder;
  stats.edgesTested = whole.edgesTested;
  stats.silhouetteEdges = whole.edges.size();
  stats.volumeTriangles = out.indices.size() / 3;
  return out;
}

std::vector<GroupPlan> planGroups(const LightVolume& volume) {
  std::vector<GroupPlan> plans;
  for (const VolumeGroup& group : volume.groups)
    plans.push_back({.eyeCount = group.eyeCount,
                     .passSides = group.passSides.count > 0,
                     .failSides = group.failSides.count > 0,
                     .failCaps = group.failCaps.count > 0});
  return plans;
}

}  // namespace umbrage::render
