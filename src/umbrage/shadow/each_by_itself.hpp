#pragma once

#include "umbrage/shadow/silhouette.hpp"

namespace umbrage::shadow {

/// In place of a silhouette, every edge of every triangle that counts: what bounds the volumes of single triangles, as the first shadow
/// engines drew them. `edges` are per triangle a use each, with the triangle's own sign; where two triangles meet theirs cancel.
/// 1. The sum of the signs over the uses of an edge is its multiplicity in findSilhouette, so the counts are those of the silhouette.
/// Source: F. Crow, shadow algorithms for computer graphics, 1977, without his contour edges.
[[nodiscard]] Silhouette eachByItself(const CasterSet& casters, const Vec4& light,
                                      const SilhouetteOptions& options = {});

/// The same of the triangles whose `side` in `silhouette` is not 0.
[[nodiscard]] Silhouette eachByItself(const CasterSet& casters, Silhouette silhouette);

/// A silhouette's edges by the sign of their multiplicity.
struct Windings {
  Silhouette straight;  ///< those above 0
  Silhouette turned;    ///< those below, with their sign turned round, and no sides of triangles
};
/// 1. extrude() gives edges of both with the same ends the same corners in the same order.
[[nodiscard]] Windings byWinding(const Silhouette& silhouette);

}  // namespace umbrage::shadow
