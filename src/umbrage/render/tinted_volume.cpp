#include "umbrage/render/tinted_volume.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/math/predicates.hpp"
#include "umbrage/render/detail/volume_shape.hpp"
#include "umbrage/shadow/hidden_casters.hpp"
#include "umbrage/shadow/layering.hpp"
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
TintedPiece sideOf(std::uint32_t a, std::uint32_t b, const TintWeight& weight) {
  return {{nearVertex(b), nearVertex(a), farVertex(a), farVertex(b)}, weight};
}

TintedPiece nearCap(const mesh::Triangle& t, const TintWeight& weight) {
  return {{nearVertex(t[0]), nearVertex(t[1]), nearVertex(t[2]), nearVertex(t[0])}, weight};
}

TintedPiece farCap(const mesh::Triangle& t, const TintWeight& weight) {
  return {{farVertex(t[0]), farVertex(t[2]), farVertex(t[1]), farVertex(t[0])}, weight};
}

/// Collects what is counted alike.
class Pieces {
 public:
  /// `sign`: -1 for what counts behind.
  explicit Pieces(int sign) : sign_(sign) {}

  void side(const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
    const auto [a, b] = weight.opaque < 0 ? std::pair(edge.b, edge.a) : std::pair(edge.a, edge.b);
    for (int i = 0; i < std::abs(weight.opaque); ++i) opaque_.push_back(sideOf(a, b, {sign_, {}}));
    if (weight.filter != shadow::FilterSum{})
      tinted_.push_back(sideOf(edge.a, edge.b, times(sign_, {0, weight.filter})));
  }
  /// `make`: nearCap or farCap; `side`: of the triangle.
  template <class Make>
  void cap(mesh::Triangle corners, int side, const TintWeight& surface, const Make& make) {
    if (surface.opaque != 0) {
      if (side < 0) std::swap(corners[1], corners[2]);
      opaque_.push_back(make(corners, {sign_, {}}));
    } else {
      tinted_.push_back(make(corners, times(sign_ * side, surface)));
    }
  }
  [[nodiscard]] PieceRange appendTo(std::vector<TintedPiece>& all) const {
    const PieceRange range{all.size(), opaque_.size(), tinted_.size()};
    all.insert(all.end(), opaque_.begin(), opaque_.end());
    all.insert(all.end(), tinted_.begin(), tinted_.end());
    return range;
  }

 private:
  int sign_;
  std::vector<TintedPiece> opaque_, tinted_;
};

/// Writes the pieces, range after range.
class Writer {
 public:
  Writer(const Outline& outline, const VolumeShape& shape, const Components& byZFail)
      : outline_(outline), shape_(shape), byZFail_(byZFail) {}

  [[nodiscard]] Pieces passSides(shadow::LightStats& stats) const {
    Pieces pieces(1);
    forEachEdge([&](const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
      if (fails(edge.component)) return;
      if (shape_.dropsParts() && !shape_.mayCount(edge.a, edge.b, edge.component))
        ++stats.sidesBehind;
      else
        pieces.side(edge, weight);
    });
    return pieces;
  }
  [[nodiscard]] Pieces passCaps() const {
    const shadow::CasterSet& casters = outline_.casters();
    Pieces pieces(1);
    for (std::uint32_t t = 0; t < casters.triangles.size(); ++t)
      if (sideAt(t) != 0 &&
          liesInPlane(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), outline_.request.eye))
        pieces.cap(casters.triangles[t], sideAt(t), outline_.surfaceWeight(t), nearCap);
    return pieces;
  }
  [[nodiscard]] Pieces failSides() const {
    Pieces pieces(-1);
    forEachEdge([&](const shadow::SilhouetteEdge& edge, const TintWeight& weight) {
      const bool isOnEye = byZFail_[edge.component] != 0 &&
                           shadow::liesOnSide(outline_.casters(), edge, outline_.request.light, outline_.request.eye);
      if (fails(edge.component) && !isOnEye) pieces.side(edge, weight);
    });
    return pieces;
  }
  [[nodiscard]] Pieces failCaps() const {
    const shadow::CasterSet& casters = outline_.casters();
    Pieces pieces(-1);
    for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
      const std::uint32_t component = casters.componentOf[t];
      if (sideAt(t) == 0 || !fails(component)) continue;
      pieces.cap(casters.triangles[t], sideAt(t), outline_.surfaceWeight(t), nearCap);
      if (!toOnePoint(component)) pieces.cap(casters.triangles[t], sideAt(t), outline_.surfaceWeight(t), farCap);
    }
    return pieces;
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
  void forEachEdge(const Fn& fn) const {
    for (std::size_t e = 0; e < outline_.weights.size(); ++e) fn(outline_.silhouette.edges[e], outline_.weights[e]);
  }

  const Outline& outline_;
  const VolumeShape& shape_;
  const Components& byZFail_;
};

// Whether what is opaque can be counted in so many bits.
bool fitsStencil(const Outline& outline) {
  const shadow::CasterSet& casters = outline.casters();
  shadow::Silhouette opaque;
  opaque.light = outline.silhouette.light;
  opaque.side = outline.silhouette.side;
  for (std::uint32_t t = 0; t < opaque.side.size(); ++t)
    if (outline.geometry.filters.isVeil(casters.surfaceTriangle[t])) opaque.side[t] = 0;
  for (std::size_t e = 0; e < outline.weights.size(); ++e) {
    if (outline.weights[e].opaque == 0) continue;
    opaque.edges.push_back(outline.silhouette.edges[e]);
    opaque.edges.back().multiplicity = outline.weights[e].opaque;
  }
  return shadow::layeringBound(casters, opaque, kTintedStencil) <= kTintedStencil;
}

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
  shape.endVolumes(request.options.finite ? shadow::sidesAtEye(casters, outline.silhouette, request.eye)
                                          : Components());
  dropUseless(outline, shape, stats);
  end("useless");
  const bool fits = fitsStencil(outline);
  end("layers");
  shadow::EyeCount atEye;
  if (zFail)
    atEye.byZFail = shadow::sidesAtEye(casters, outline.silhouette, request.eye);
  else
    atEye = shadow::countAtEye(casters, outline.silhouette, request.eye);
  shape.endVolumes(atEye.byZFail);
  end("silhouette");

  TintedVolume out;
  out.fitsStencil = fits;
  out.atEye = sumAtEye(outline, atEye);
  out.farPoints = farPointsOf(outline, shape);
  const Writer writer(outline, shape, atEye.byZFail);
  out.passSides = writer.passSides(stats).appendTo(out.pieces);
  out.passCaps = writer.passCaps().appendTo(out.pieces);
  out.failSides = writer.failSides().appendTo(out.pieces);
  out.failCaps = writer.failCaps().appendTo(out.pieces);
  if (!zFail) {
    stats.castersByZFail = atEye.byZFailCount;
    for (std::size_t c = 0; c < stats.choices.size(); ++c)
      if (atEye.byZFail[c] != 0 && stats.choices[c] == shadow::CasterChoice::zPass)
        stats.choices[c] = shadow::CasterChoice::zFailTouched;
  }
  stats.method = std::string("transparent, ") + name(request.counting);
  stats.eyeCount = atEye.count;
  if (shape.reach() != nullptr) stats.endlessCasters = shape.reach()->endlessCount();
  stats.volumeTriangles =
      2 * (out.passSides.all().count + out.failSides.all().count) + out.passCaps.all().count + out.failCaps.all().count;
  out.side = std::move(outline.silhouette.side);
  end("extrude");
  return out;
}

}  // namespace umbrage::render
