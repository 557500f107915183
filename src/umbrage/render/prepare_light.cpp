#include "umbrage/render/prepare_light.hpp"

namespace umbrage::render {
namespace {

IndexRange append(std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& more) {
  const IndexRange range{indices.size(), more.size()};
  indices.insert(indices.end(), more.begin(), more.end());
  return range;
}

void addZFail(LightVolume& out, const shadow::CasterSet& casters, const shadow::Silhouette& silhouette,
              std::span<const std::uint8_t> components) {
  shadow::ShadowVolume volume = shadow::extrude(casters, silhouette, {.caps = true, .components = components});
  if (out.indices.empty()) {
    out.indices = std::move(volume.sides);
    out.failSides = {0, out.indices.size()};
  } else {
    out.failSides = append(out.indices, volume.sides);
  }
  out.failCaps = append(out.indices, volume.caps);
}

void addZPass(LightVolume& out, const shadow::CasterSet& casters, const shadow::Silhouette& silhouette,
              const shadow::EyeCount& atEye) {
  std::vector<std::uint8_t> others;
  if (atEye.byZFailCount > 0)
    for (const std::uint8_t fallen : atEye.byZFail) others.push_back(fallen == 0 ? 1 : 0);
  out.indices = shadow::extrude(casters, silhouette, {.caps = false, .components = others}).sides;
  out.passSides = {0, out.indices.size()};
  if (atEye.byZFailCount > 0) addZFail(out, casters, silhouette, atEye.byZFail);
}

}  // namespace

LightVolume prepareVolume(const shadow::CasterSet& casters, const Vec4& light, const Vec3& eye, Counting counting,
                          shadow::LightStats& stats, const PhaseEnd& ended) {
  const auto end = [&](const char* phase) {
    if (ended) ended(phase);
  };
  LightVolume out;
  out.light = light;
  out.counting = counting;
  const shadow::Silhouette silhouette = shadow::findSilhouette(casters, light);
  shadow::EyeCount atEye;
  if (counting == Counting::zPass) atEye = shadow::countAtEye(casters, silhouette, eye);
  end("silhouette");
  if (counting == Counting::zPass)
    addZPass(out, casters, silhouette, atEye);
  else
    addZFail(out, casters, silhouette, {});
  end("extrude");

  out.eyeCount = atEye.count;
  stats.method = counting == Counting::zPass ? "zpass" : "zfail";
  stats.edgesTested = silhouette.edgesTested;
  stats.silhouetteEdges = silhouette.edges.size();
  stats.volumeTriangles = out.indices.size() / 3;
  stats.castersByZFail = atEye.byZFailCount;
  stats.eyeCount = atEye.count;
  return out;
}

}  // namespace umbrage::render
