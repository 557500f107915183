#include "umbrage/render/tinted_volume.hpp"

#include <algorithm>

#include "umbrage/base/check.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/render/detail/volume_shape.hpp"
#include "umbrage/shadow/hidden_casters.hpp"
#include "umbrage/shadow/tinted_silhouette.hpp"

namespace umbrage::render {
namespace {

using detail::Components;
using detail::VolumeShape;

TintWeight times(int sign, const TintWeight& w) {
  return {sign * w.opaque, {sign * w.filter[0], sign * w.filter[1], sign * w.filter[2]}};
}

// What is known of the volumes before they are pieces.
struct Outline {
  const shadow::Geometry& geometry;
  const VolumeRequest& request;
  shadow::Silhouette silhouette;    ///< its multiplicities mean nothing
  std::vector<TintWeight> weights;  ///< per edge
  Components veiled;

  Outline(const shadow::Geometry& g, const VolumeRequest& r) : geometry(g), request(r) {
    shadow::TintedSilhouette found = shadow::findTintedSilhouette(g.casters, g.filters, r.light);
    silhouette.light = r.light;
    silhouette.side = std::move(found.side);
    silhouette.edgesTested = g.casters.edges.size();
    for (const shadow::TintedEdge& e : found.edges) {
      silhouette.edges.push_back({e.a, e.b, 1, g.casters.componentOfPosition[e.a]});
      weights.push_back({e.opaque, e.filter});
    }
    veiled = shadow::veiledComponents(g.casters, g.filters);
  }

  [[nodiscard]] const shadow::CasterSet& casters() const { return geometry.casters; }
  [[nodiscard]] TintWeight surfaceWeight(std::uint32_t caster) const {
    const std::uint32_t surface = casters().surfaceTriangle[caster];
    return {geometry.filters.isVeil(surface) ? 0 : 1, geometry.filters.of(surface)};
  }
};

void tell(shadow::LightStats& stats, const Components& flags, shadow::CasterChoice choice) {
  for (std::size_t c = 0; c < stats.choices.size(); ++c)
    if (flags[c] != 0) stats.choices[c] = choice;
}

void dropUseless(Outline& outline, const VolumeShape& shape, shadow::LightStats& stats) {
  const shadow::CasterSet& casters = outline.casters();
  Components useless(casters.componentCount, 0);
  if (shape.dropsParts()) {
    useless = shape.withoutReceivers();
    stats.castersBehind = static_cast<std::size_t>(std::count(useless.begin(), useless.end(), 1));
    tell(stats, useless, shadow::CasterChoice::noReceiver);
  }
  if (outline.request.options.hiddenCasters) {
    const auto hidden = shadow::findHiddenCasters(casters, outline.request.light, useless, outline.veiled);
    stats.castersHidden = hidden.count;
    tell(stats, hidden.component, shadow::CasterChoice::hidden);
    for (std::uint32_t c = 0; c < casters.componentCount; ++c) useless[c] |= hidden.component[c];
  }
  std::size_t kept = 0;
  for (std::size_t e = 0; e < outline.weights.size(); ++e)
    if (useless[outline.silhouette.edges[e].component] == 0) outline.weights[kept++] = outline.weights[e];
  outline.weights.resize(kept);
  outline.silhouette = shadow::without(casters, std::move(outline.silhouette), useless);
}

std::uint32_t nearVertex(std::uint32_t i) { return 2 * i; }
std::uint32_t farVertex(std::uint32_t i) { return 2 * i + 1; }

// A cap that runs a -> b, counter-clockwise as the light sees it, is continued by a side that runs b -> a.
TintedPiece sideOf(const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
  return {{nearVertex(edge.b), nearVertex(edge.a), farVertex(edge.a), farVertex(edge.b)}, weight};
}

TintedPiece nearCap(const mesh::Triangle& t, const TintWeight& weight) {
  return {{nearVertex(t[0]), nearVertex(t[1]), nearVertex(t[2]), nearVertex(t[0])}, weight};
}

TintedPiece farCap(const mesh::Triangle& t, const TintWeight& weight) {
  return {{farVertex(t[0]), farVertex(t[2]), farVertex(t[1]), farVertex(t[0])}, weight};
}

/// Writes the pieces, range after range.
class Writer {
 public:
  Writer(const Outline& outline, const VolumeShape& shape, const Components& byZFail, TintedVolume& out)
      : outline_(outline), shape_(shape), byZFail_(byZFail), out_(out) {}

  void passSides(shadow::LightStats& stats) {
    write(out_.passSides, [&] {
      forEachEdge([&](const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
        if (fails(edge.component)) return;
        if (shape_.dropsParts() && !shape_.mayCount(edge.a, edge.b, edge.component))
          ++stats.sidesBehind;
        else
          out_.pieces.push_back(sideOf(edge, weight));
      });
    });
  }
  void passCaps() {
    const shadow::CasterSet& casters = outline_.casters();
    write(out_.passCaps, [&] {
      for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
        if (sideAt(t) != 0 && liesInPlane(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), outline_.request.eye))
          out_.pieces.push_back(nearCap(casters.triangles[t], times(sideAt(t), outline_.surfaceWeight(t))));
    });
  }
  void failSides() {
    write(out_.failSides, [&] {
      forEachEdge([&](const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
        const bool isOnEye = byZFail_[edge.component] != 0 &&
                             shadow::liesOnSide(outline_.casters(), edge, outline_.request.light, outline_.request.eye);
        if (fails(edge.component) && !isOnEye) out_.pieces.push_back(sideOf(edge, times(-1, weight)));
      });
    });
  }
  void failCaps() {
    const shadow::CasterSet& casters = outline_.casters();
    write(out_.failCaps, [&] {
      for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
        const std::uint32_t component = casters.componentOf[t];
        if (sideAt(t) == 0 || !fails(component)) continue;
        const TintWeight weight = times(-sideAt(t), outline_.surfaceWeight(t));
        out_.pieces.push_back(nearCap(casters.triangles[t], weight));
        if (!toOnePoint(component)) out_.pieces.push_back(farCap(casters.triangles[t], weight));
      }
    });
  }

 private:
  [[nodiscard]] int sideAt(std::uint32_t t) const { return outline_.silhouette.side[t]; }
  [[nodiscard]] bool fails(std::uint32_t component) const {
    return outline_.request.counting == Counting::zFail || byZFail_[component] != 0;
  }
  [[nodiscard]] bool toOnePoint(std::uint32_t component) const {
    return outline_.request.light.w == 0.0 && (shape_.reach() == nullptr || shape_.reach()->isEndless(component));
  }
  template <class Fn>
  void write(IndexRange& range, const Fn& fn) {
    range.first = out_.pieces.size();
    fn();
    range.count = out_.pieces.size() - range.first;
  }
  template <class Fn>
  void forEachEdge(const Fn& fn) const {
    for (std::size_t e = 0; e < outline_.weights.size(); ++e) fn(outline_.silhouette.edges[e], outline_.weights[e]);
  }

  const Outline& outline_;
  const VolumeShape& shape_;
  const Components& byZFail_;
  TintedVolume& out_;
};

std::vector<Vec4f> farPointsOf(const Outline& outline, const VolumeShape& shape) {
  const shadow::CasterSet& casters = outline.casters();
  const auto& request = outline.request;
  if (shape.reach() != nullptr) return shadow::farPoints(casters, *shape.reach(), request.light, request.eye);
  shadow::Reach endless;
  endless.plane.assign(casters.componentCount, shadow::Reach::kEndless);
  return shadow::farPoints(casters, endless, request.light, request.eye);
}

TintWeight sumAtEye(const Outline& outline, const shadow::EyeCount& atEye) {
  TintWeight sum;
  for (const std::uint32_t t : atEye.crossed) {
    const TintWeight w = outline.surfaceWeight(t);
    sum.opaque += w.opaque;
    for (std::size_t k = 0; k < 3; ++k) sum.filter[k] += w.filter[k];
  }
  return sum;
}

}  // namespace

TintedVolume prepareTinted(const shadow::Geometry& geometry, const VolumeRequest& request, shadow::LightStats& stats,
                           const PhaseEnd& ended) {
  UMBRAGE_CHECK(request.counting == Counting::zFail || request.counting == Counting::zPass, "z-fail or z-pass");
  const auto end = [&](const char* phase) {
    if (ended) ended(phase);
  };
  const shadow::CasterSet& casters = geometry.casters;
  const bool zFail = request.counting == Counting::zFail;
  Outline outline(geometry, request);
  stats.finder = "brute_force";
  stats.edgesTested = casters.edges.size();
  stats.silhouetteEdges = outline.weights.size();
  if (request.detailed)
    stats.choices.assign(casters.componentCount, zFail ? shadow::CasterChoice::zFail : shadow::CasterChoice::zPass);
  end("silhouette");

  VolumeShape shape({casters, request.light, request.eye, request.options, request.receivers, request.tiles});
  shape.endVolumes(request.options.finite ? shadow::sidesAtEye(casters, outline.silhouette, request.eye) : Components());
  dropUseless(outline, shape, stats);
  end("useless");
  shadow::EyeCount atEye;
  if (zFail)
    atEye.byZFail = shadow::sidesAtEye(casters, outline.silhouette, request.eye);
  else
    atEye = shadow::countAtEye(casters, outline.silhouette, request.eye);
  shape.endVolumes(atEye.byZFail);
  end("silhouette");

  TintedVolume out;
  out.atEye = sumAtEye(outline, atEye);
  out.farPoints = farPointsOf(outline, shape);
  Writer writer(outline, shape, atEye.byZFail, out);
  writer.passSides(stats);
  writer.passCaps();
  writer.failSides();
  writer.failCaps();
  if (!zFail) {
    stats.castersByZFail = atEye.byZFailCount;
    for (std::size_t c = 0; c < stats.choices.size(); ++c)
      if (atEye.byZFail[c] != 0 && stats.choices[c] == shadow::CasterChoice::zPass)
        stats.choices[c] = shadow::CasterChoice::zFailTouched;
  }
  stats.method = std::string("transparent, ") + name(request.counting);
  stats.eyeCount = atEye.count;
  if (shape.reach() != nullptr) stats.endlessCasters = shape.reach()->endlessCount();
  stats.volumeTriangles = 2 * (out.passSides.count + out.failSides.count) + out.passCaps.count + out.failCaps.count;
  out.side = std::move(outline.silhouette.side);
  end("extrude");
  return out;
}

}  // namespace umbrage::render
