#include "umbrage/render/prepare_light.hpp"

#include <array>
#include <utility>

#include "umbrage/shadow/hidden_casters.hpp"
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

// What is counted together, before it is extruded.
struct Part {
  shadow::Silhouette silhouette;
  shadow::EyeCount atEye;  // for z-fail: only which components the eye touches
};

// One light's volumes in the making.
class Builder {
 public:
  // Where a volume's end is rounded, a side that holds the eye may turn out on its wrong side: what the eye touches has no end.
  Builder(const VolumeRequest& request, std::span<const std::uint8_t> atEye, shadow::LightStats& stats)
      : request_(request), stats_(stats) {
    out_.light = request.light;
    out_.counting = request.counting;
    if (!request.options.finite) return;
    Box3 room = request.receivers;
    room.add(request.eye);
    reach_ = shadow::reachWithin(request.casters(), request.light, room, atEye);
    out_.farPoints = shadow::farPoints(request.casters(), reach_, request.light, request.eye);
    stats.endlessCasters = reach_.endlessCount();
  }

  // Which components are drawn at all.
  void findUseful() {
    if (request_.tiles == nullptr || !request_.options.hiddenParts) return;
    const shadow::CasterSet& casters = request_.casters();
    useful_.assign(casters.componentCount, 1);
    for (std::uint32_t c = 0; c < casters.componentCount; ++c) {
      const auto hull = hullOf(c);
      const bool zFail = request_.counting == Counting::zFail;
      if (request_.tiles->behindAll(hull) || (zFail && request_.tiles->beforeAll(hull))) useful_[c] = 0;
    }
  }

  void addGroup(const Part& part) {
    const auto& [silhouette, atEye] = part;
    VolumeGroup group{.eyeCount = atEye.count, .passSides = {}, .failSides = {}, .failCaps = {}};
    const bool zPass = request_.counting != Counting::zFail;
    if (zPass) group.passSides = append(out_.indices, passSides(silhouette, atEye));
    if (!zPass || atEye.byZFailCount > 0) {
      const std::span<const std::uint8_t> chosen = zPass ? std::span(atEye.byZFail) : std::span(useful_);
      shadow::ShadowVolume volume =
          shadow::extrude(request_.casters(), silhouette, {.components = chosen, .reach = reach(), .keepSide = {}});
      group.failSides = append(out_.indices, std::move(volume.sides));
      group.failCaps = append(out_.indices, std::move(volume.caps));
    }
    for (const shadow::SilhouetteEdge& edge : silhouette.edges) drawn_[edge.component] = 1;
    out_.groups.push_back(group);
  }

  LightVolume finish() {
    stats_.volumeTriangles = out_.indices.size() / 3;
    for (std::size_t c = 0; c < useful_.size(); ++c) stats_.castersBehind += useful_[c] == 0 && drawn_[c] != 0;
    return std::move(out_);
  }

 private:
  [[nodiscard]] const shadow::Reach* reach() const { return request_.options.finite ? &reach_ : nullptr; }

  [[nodiscard]] Vec4 relative(const Vec4& p) const { return p - Vec4(request_.eye * p.w, 0.0); }

  // Points whose convex hull holds the volume of a component.
  [[nodiscard]] std::array<Vec4, 16> hullOf(std::uint32_t component) const {
    const Box3& box = request_.casters().componentBounds[component];
    std::array<Vec4, 16> hull;
    for (std::size_t i = 0; i < 8; ++i) {
      const Vec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                        (i & 4) != 0 ? box.max.z : box.min.z);
      hull[i] = relative(Vec4(corner, 1.0));
      hull[8 + i] = relative(farEnd(component, corner));
    }
    return hull;
  }

  [[nodiscard]] Vec4 farEnd(std::uint32_t component, const Vec3& corner) const {
    if (request_.options.finite) return shadow::farPoint(reach_, component, corner, request_.light);
    return {corner * request_.light.w - Vec3(request_.light), 0.0};
  }

  [[nodiscard]] bool mayCount(const shadow::SilhouetteEdge& edge) {
    const Vec3 a = request_.casters().position(edge.a), b = request_.casters().position(edge.b);
    const std::array<Vec4, 4> hull{relative(Vec4(a, 1.0)), relative(Vec4(b, 1.0)),
                                   relative(farEnd(edge.component, a)), relative(farEnd(edge.component, b))};
    const bool useless = request_.tiles->behindAll(hull);
    stats_.sidesBehind += useless;
    return !useless;
  }

  [[nodiscard]] std::vector<std::uint32_t> passSides(const shadow::Silhouette& silhouette,
                                                     const shadow::EyeCount& atEye) {
    std::vector<std::uint8_t> chosen = useful_;
    if (atEye.byZFailCount > 0) {
      chosen.resize(atEye.byZFail.size(), 1);
      for (std::size_t c = 0; c < chosen.size(); ++c) chosen[c] = chosen[c] != 0 && atEye.byZFail[c] == 0;
    }
    shadow::ExtrudeOptions options{.caps = false, .components = chosen, .reach = reach(), .keepSide = {}};
    if (!useful_.empty()) options.keepSide = [this](const shadow::SilhouetteEdge& edge) { return mayCount(edge); };
    return shadow::extrude(request_.casters(), silhouette, options).sides;
  }

  const VolumeRequest& request_;
  shadow::LightStats& stats_;
  shadow::Reach reach_;
  std::vector<std::uint8_t> useful_;  // per component; empty: all
  std::vector<std::uint8_t> drawn_ = std::vector<std::uint8_t>(request_.casters().componentCount, 0);
  LightVolume out_;
};

shadow::LayerGroups groupsFor(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette) {
  if (shadow::layeringBound(casters, silhouette, kWholeStencil) <= kWholeStencil) return {};
  return shadow::groupLayers(casters, silhouette, kSharedStencil);
}

shadow::Silhouette silhouetteFor(const VolumeRequest& request, shadow::LightStats& stats) {
  shadow::Silhouette silhouette = request.finder.silhouette(request.light);
  stats.finder = silhouette.finder;
  stats.edgesTested = silhouette.edgesTested;
  if (!request.options.hiddenCasters) return silhouette;
  const shadow::HiddenCasters hidden = shadow::findHiddenCasters(request.casters(), request.light);
  stats.castersHidden = hidden.count;
  return shadow::without(request.casters(), std::move(silhouette), hidden);
}

std::vector<Part> partsOf(const VolumeRequest& request, shadow::Silhouette whole, const shadow::LayerGroups& groups) {
  std::vector<Part> parts;
  for (int g = 0; g < groups.count; ++g) {
    Part part{groups.count > 1 ? shadow::restrictTo(request.casters(), whole, groups, g) : std::move(whole), {}};
    if (request.counting == Counting::zPass)
      part.atEye = shadow::countAtEye(request.casters(), part.silhouette, request.eye);
    else if (request.counting == Counting::zMixed)
      part.atEye = shadow::chooseAtEye(request.casters(), part.silhouette, request.eye);
    else if (request.options.finite)
      part.atEye.byZFail = shadow::sidesAtEye(request.casters(), part.silhouette, request.eye);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace

const char* name(Counting counting) {
  switch (counting) {
    case Counting::zFail: return "zfail";
    case Counting::zPass: return "zpass";
    case Counting::zMixed: return "zmixed";
  }
  return "?";
}

LightVolume prepareVolume(const VolumeRequest& request, shadow::LightStats& stats, const PhaseEnd& ended) {
  const auto end = [&](const char* phase) {
    if (ended) ended(phase);
  };
  shadow::Silhouette whole = silhouetteFor(request, stats);
  stats.silhouetteEdges = whole.edges.size();
  end("silhouette");
  const shadow::LayerGroups groups = groupsFor(request.casters(), whole);
  end("layers");
  std::vector<Part> parts = partsOf(request, std::move(whole), groups);
  std::vector<std::uint8_t> atEye(request.casters().componentCount, 0);
  for (const Part& part : parts)
    for (std::size_t c = 0; c < part.atEye.byZFail.size(); ++c) atEye[c] |= part.atEye.byZFail[c];
  end("silhouette");
  Builder builder(request, atEye, stats);
  builder.findUseful();
  for (const Part& part : parts) {
    builder.addGroup(part);
    if (request.counting == Counting::zFail) continue;
    stats.castersByZFail += part.atEye.byZFailCount;
    stats.eyeCount += part.atEye.count;
  }
  end("extrude");
  stats.method = name(request.counting);
  return builder.finish();
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
