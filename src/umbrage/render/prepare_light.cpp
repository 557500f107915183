#include "umbrage/render/prepare_light.hpp"

#include <array>
#include <optional>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/render/carry.hpp"
#include "umbrage/render/detail/volume_shape.hpp"
#include "umbrage/render/near_rectangle.hpp"
#include "umbrage/shadow/each_by_itself.hpp"
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

using detail::Components;
using Shape = detail::VolumeShape;

// What is counted together, before it is extruded.
struct Part {
  shadow::Silhouette silhouette;
  shadow::EyeCount atEye;  // for z-fail: only which components the eye touches
};

detail::VolumeShape shapeOf(const VolumeRequest& request) {
  return detail::VolumeShape(
      {request.casters(), request.light, request.eye, request.options, request.receivers, request.tiles});
}

// For LightStats::choices, where they are wanted: what became of the components that are flagged.
void tell(shadow::LightStats& stats, const Components& flags, shadow::CasterChoice choice) {
  for (std::size_t c = 0; c < stats.choices.size(); ++c)
    if (flags[c] != 0) stats.choices[c] = choice;
}

bool countsBehind(Counting counting) { return counting == Counting::zFail || counting == Counting::eachTriangle; }

void beginChoices(const VolumeRequest& request, shadow::LightStats& stats) {
  const bool zFail = countsBehind(request.counting);
  if (request.detailed)
    stats.choices.assign(request.casters().componentCount,
                         zFail ? shadow::CasterChoice::zFail : shadow::CasterChoice::zPass);
}

// Which components need not be drawn.
Components findUseless(const VolumeRequest& request, const Shape& shape, shadow::LightStats& stats) {
  const shadow::CasterSet& casters = request.casters();
  Components useless(casters.componentCount, 0);
  if (shape.dropsParts()) {
    useless = shape.withoutReceivers();
    stats.castersBehind = static_cast<std::size_t>(std::count(useless.begin(), useless.end(), 1));
    tell(stats, useless, shadow::CasterChoice::noReceiver);
  }
  if (request.options.hiddenCasters) {
    const shadow::HiddenCasters hidden = shadow::findHiddenCasters(casters, request.light, useless);
    stats.castersHidden = hidden.count;
    tell(stats, hidden.component, shadow::CasterChoice::hidden);
    for (std::uint32_t c = 0; c < casters.componentCount; ++c) useless[c] |= hidden.component[c];
  }
  return useless;
}

shadow::LayerGroups groupsFor(const shadow::CasterSet& casters, const shadow::Silhouette& silhouette,
                              Overflow overflow) {
  if (overflow != Overflow::none) return {};
  if (shadow::layeringBound(casters, silhouette, kWholeStencil) <= kWholeStencil) return {};
  return shadow::groupLayers(casters, silhouette, kSharedStencil);
}

// What the light sees through the near rectangle, which reaches half as far from the eye as any side that is counted.
std::optional<Mat4> nearView(const VolumeRequest& request) {
  if (request.counting != Counting::zPassPlus) return std::nullopt;
  UMBRAGE_CHECK(request.view != nullptr, "a near rectangle is seen in a view");
  const shadow::CasterSet& casters = request.casters();
  const double radius = 0.5 * shadow::eyeThreshold(casters, request.light, request.eye);
  const double reach = glm::length(casters.bounds.centre() - request.eye) + casters.bounds.radius();
  const Vec4 light = request.light - Vec4(request.eye * request.light.w, 0.0);
  return throughNearRectangle(*request.view, nearRectangleDistance(*request.view, radius), light, reach);
}

// What the light sees of a part's casters on its way to the near rectangle.
IndexRange appendNearCasters(LightVolume& out, const VolumeRequest& request, const Part& part, const Mat4& fromLight) {
  const shadow::CasterSet& casters = request.casters();
  const shadow::EyeCount between = shadow::chooseAtEye(casters, part.silhouette, request.eye);
  const std::size_t first = out.nearPoints.size();
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    const std::uint32_t c = casters.componentOf[t];
    if (part.silhouette.side[t] == 0 || between.byZFail[c] == 0 || part.atEye.byZFail[c] != 0) continue;
    const auto corner = [&](int k) { return casters.corner(t, k) - request.eye; };
    appendSeen(fromLight, {corner(0), corner(1), corner(2)}, out.nearPoints);
  }
  std::vector<std::uint32_t> indices;
  for (std::size_t i = first; i < out.nearPoints.size(); ++i) indices.push_back(static_cast<std::uint32_t>(2 * i + 1));
  return append(out.indices, std::move(indices));
}

std::vector<Part> partsOf(const VolumeRequest& request, shadow::Silhouette whole, const shadow::LayerGroups& groups,
                          bool countsByDrawing) {
  std::vector<Part> parts;
  for (int g = 0; g < groups.count; ++g) {
    Part part{groups.count > 1 ? shadow::restrictTo(request.casters(), whole, groups, g) : std::move(whole), {}};
    if (request.counting == Counting::eachTriangle && groups.count > 1)
      part.silhouette = shadow::eachByItself(request.casters(), std::move(part.silhouette));
    if (countsByDrawing)
      part.atEye = shadow::touchesEye(request.casters(), part.silhouette, request.eye);
    else if (request.counting == Counting::zPass || request.counting == Counting::zPassPlus)
      part.atEye = shadow::countAtEye(request.casters(), part.silhouette, request.eye);
    else if (request.counting == Counting::zMixed)
      part.atEye = shadow::chooseAtEye(request.casters(), part.silhouette, request.eye);
    else
      part.atEye.byZFail = shadow::sidesAtEye(request.casters(), part.silhouette, request.eye);
    parts.push_back(std::move(part));
  }
  return parts;
}

// What the eye touches in any part. A group's silhouette has edges that the whole has not.
Components touched(const VolumeRequest& request, const std::vector<Part>& parts) {
  Components all(request.casters().componentCount, 0);
  for (const Part& part : parts)
    for (std::size_t c = 0; c < part.atEye.byZFail.size(); ++c) all[c] |= part.atEye.byZFail[c];
  return all;
}

bool sidesAsEdges(const VolumeRequest& request) {
  return request.options.extrusion == shadow::Extrusion::geometryShader;
}

// Triangles that are drawn. Edges become sides, of one triangle where all their far vertices are one point.
std::size_t trianglesIn(const LightVolume& volume, bool sidesAsEdges) {
  const std::size_t side = volume.farPoints.empty() && volume.light.w == 0.0 ? 1 : 2;
  std::size_t triangles = volume.indices.size() / 3;
  if (!sidesAsEdges) return triangles;
  triangles = 0;
  for (const VolumeGroup& g : volume.groups)
    triangles += (g.passSides.count + g.failSides.count + g.turnedSides.count) / 2 * side +
                 (g.failCaps.count + g.nearCasters.count) / 3;
  return triangles;
}

std::vector<std::uint32_t> passSides(const VolumeRequest& request, const Part& part, const Shape& shape,
                                     shadow::LightStats& stats) {
  Components chosen;
  if (part.atEye.byZFailCount > 0)
    for (const std::uint8_t fallen : part.atEye.byZFail) chosen.push_back(fallen == 0 ? 1 : 0);
  shadow::ExtrudeOptions options{.caps = false,
                                 .components = chosen,
                                 .reach = shape.reach(),
                                 .keepSide = {},
                                 .sidesAsEdges = sidesAsEdges(request)};
  if (shape.dropsParts())
    options.keepSide = [&](const shadow::SilhouetteEdge& edge) {
      const bool keep = shape.mayCount(edge.a, edge.b, edge.component);
      stats.sidesBehind += !keep;
      return keep;
    };
  return shadow::extrude(request.casters(), part.silhouette, options).sides;
}

// What was left out before has no part in the silhouette any more, but a box that may lie anywhere.
void tellByZFail(const VolumeRequest& request, const Part& part, shadow::LightStats& stats) {
  const bool between = request.counting == Counting::zMixed;
  for (std::size_t c = 0; c < stats.choices.size(); ++c)
    if (part.atEye.byZFail[c] != 0 && stats.choices[c] == shadow::CasterChoice::zPass)
      stats.choices[c] = between ? shadow::CasterChoice::zFailBetween : shadow::CasterChoice::zFailTouched;
}

void addGroup(LightVolume& out, const VolumeRequest& request, const Part& part, const Shape& shape,
              shadow::LightStats& stats) {
  VolumeGroup group{.eyeCount = part.atEye.count, .nearCasters = {}, .passSides = {}, .failSides = {}, .failCaps = {}};
  const bool zFail = countsBehind(request.counting);
  if (!zFail) group.passSides = append(out.indices, passSides(request, part, shape, stats));
  if (zFail || part.atEye.byZFailCount > 0) {
    const std::span<const std::uint8_t> chosen =
        zFail ? std::span<const std::uint8_t>() : std::span(part.atEye.byZFail);
    const auto isSeen = [&](const shadow::SilhouetteEdge& edge) {
      return part.atEye.byZFail[edge.component] == 0 ||
             !shadow::liesOnSide(request.casters(), edge, request.light, request.eye);
    };
    const auto extrude = [&](const shadow::Silhouette& silhouette, bool caps) {
      return shadow::extrude(request.casters(), silhouette,
                             {.caps = caps,
                              .components = chosen,
                              .reach = shape.reach(),
                              .keepSide = isSeen,
                              .sidesAsEdges = sidesAsEdges(request),
                              .eye = request.eye});
    };
    shadow::ShadowVolume volume;
    if (request.counting == Counting::eachTriangle) {
      auto [straight, turned] = shadow::byWinding(part.silhouette);
      volume = extrude(straight, true);
      group.turnedSides = append(out.indices, extrude(turned, false).sides);
    } else {
      volume = extrude(part.silhouette, true);
    }
    group.failSides = append(out.indices, std::move(volume.sides));
    group.failCaps = append(out.indices, std::move(volume.caps));
    if (!zFail) {
      stats.castersByZFail += part.atEye.byZFailCount;
      tellByZFail(request, part, stats);
    }
  }
  stats.eyeCount += part.atEye.count;
  out.groups.push_back(group);
}

}  // namespace

const char* name(Counting counting) {
  switch (counting) {
    case Counting::zFail: return "zfail";
    case Counting::zPass: return "zpass";
    case Counting::zMixed: return "zmixed";
    case Counting::zPassPlus: return "zp_plus";
    case Counting::eachTriangle: return "volumes_brute";
  }
  return "?";
}

LightVolume prepareVolume(const VolumeRequest& request, shadow::LightStats& stats, const PhaseEnd& ended) {
  const auto end = [&](const char* phase) {
    if (ended) ended(phase);
  };
  const shadow::CasterSet& casters = request.casters();
  const bool eachTriangle = request.counting == Counting::eachTriangle;
  shadow::Silhouette whole =
      eachTriangle ? shadow::eachByItself(casters, request.light) : request.finder.silhouette(request.light);
  stats.method = name(request.counting);
  stats.finder = whole.finder;
  stats.edgesTested = whole.edgesTested;
  stats.silhouetteEdges = whole.edges.size();
  end("silhouette");

  beginChoices(request, stats);
  Shape shape = shapeOf(request);
  shape.endVolumes(request.options.finite ? shadow::sidesAtEye(casters, whole, request.eye) : Components());
  whole = shadow::without(casters, std::move(whole), findUseless(request, shape, stats));
  end("useless");
  const shadow::LayerGroups groups = groupsFor(casters, whole, request.options.overflow);
  end("layers");
  const std::optional<Mat4> throughNear = nearView(request);
  const std::vector<Part> parts = partsOf(request, std::move(whole), groups, throughNear.has_value());
  end("silhouette");

  LightVolume out;
  out.light = request.light;
  out.counting = request.counting;
  shape.endVolumes(touched(request, parts));
  if (const shadow::Reach* reach = shape.reach(); reach != nullptr) {
    out.farPoints = shadow::farPoints(casters, *reach, request.light, request.eye);
    stats.endlessCasters = reach->endlessCount();
  }
  out.nearDegenerates = request.counting == Counting::zPassPlus && !throughNear;
  for (const Part& part : parts) {
    addGroup(out, request, part, shape, stats);
    if (throughNear) out.groups.back().nearCasters = appendNearCasters(out, request, part, *throughNear);
  }
  stats.volumeTriangles = trianglesIn(out, sidesAsEdges(request));
  if (request.options.extrusion == shadow::Extrusion::processor) carryOnProcessor(casters, request.eye, out);
  end("extrude");
  return out;
}

LightVolume prepareOnCard(const VolumeRequest& request, shadow::LightStats& stats, const PhaseEnd& ended) {
  UMBRAGE_CHECK(request.counting != Counting::eachTriangle, "single triangles are extruded by the processor");
  UMBRAGE_CHECK(request.counting != Counting::zPassPlus, "a near rectangle is counted by the processor");
  const shadow::CasterSet& casters = request.casters();
  stats.method = name(request.counting);
  stats.finder = shadow::name(shadow::FinderKind::gpu);
  stats.edgesTested = casters.edges.size();
  LightVolume out{.light = request.light, .counting = request.counting};
  out.groups.emplace_back();
  beginChoices(request, stats);
  Shape shape = shapeOf(request);
  const Components between = shadow::boxesBetween(casters, request.light, request.eye);
  shape.endVolumes(between);
  if (request.counting != Counting::zFail) tell(stats, between, shadow::CasterChoice::zFailBetween);
  const Components useless = findUseless(request, shape, stats);
  for (std::uint32_t c = 0; c < casters.componentCount; ++c) {
    const Role role = between[c] != 0 ? Role::failAtEye : request.counting == Counting::zFail ? Role::fail : Role::pass;
    out.roles.push_back(useless[c] != 0 ? Role::leftOut : role);
    stats.castersByZFail += request.counting != Counting::zFail && out.roles.back() == Role::failAtEye;
  }
  if (ended) ended("useless");
  if (const shadow::Reach* reach = shape.reach(); reach != nullptr) {
    out.farPoints = shadow::farPoints(casters, *reach, request.light, request.eye);
    stats.endlessCasters = reach->endlessCount();
  }
  if (ended) ended("extrude");
  return out;
}

std::vector<GroupPlan> planGroups(const LightVolume& volume) {
  if (!volume.roles.empty()) {
    const auto any = [&](auto which) { return std::any_of(volume.roles.begin(), volume.roles.end(), which); };
    const bool fails = any([](Role r) { return r == Role::fail || r == Role::failAtEye; });
    return {{.passSides = any([](Role r) { return r == Role::pass; }), .failSides = fails, .failCaps = fails}};
  }
  std::vector<GroupPlan> plans;
  for (const VolumeGroup& group : volume.groups)
    plans.push_back({.eyeCount = group.eyeCount,
                     .nearCasters = group.nearCasters.count > 0,
                     .passSides = group.passSides.count > 0,
                     .failSides = group.failSides.count > 0,
                     .failCaps = group.failCaps.count > 0,
                     .turnedSides = group.turnedSides.count > 0});
  return plans;
}

}  // namespace umbrage::render
