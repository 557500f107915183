#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "umbrage/base/progress.hpp"
#include "umbrage/cut/effort.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::cut {

/// A convex, flat part of a triangle that every light reaches as a whole or not at all.
struct Piece {
  std::uint32_t triangle;    ///< of Surfaces
  std::uint32_t begin, end;  ///< of Pieces::corners, in order around the piece
  std::uint64_t litBy;       ///< bit k: light k reaches the side that faces it
};
/// The surfaces of a scene, cut.
/// 1. In the order of the triangles; those of one triangle cover it and do not overlap. A triangle that no border crosses is one piece, with its own corners
///    to the bit. Triangles without area are left out.
/// 2. Neighbouring pieces share borders, but not corners: where one is cut and the other is not, a corner of the one lies on an edge of the other.
struct Pieces {
  std::vector<Vec3> corners;  ///< relative to Surfaces::origin
  std::vector<Piece> pieces;
};

inline constexpr std::size_t kMostLights = 64;

/// Cuts all surfaces by the shadows of all casters under each light (see LightCutter).
/// REQUIRES: at most kMostLights lights, all valid.
/// Errors: ErrorCode::input when the work passes `limits` (none: Effort::usual), ErrorCode::device when memory runs out; as the sink says when it asks to stop.
[[nodiscard]] Result<Pieces> cutSurfaces(const std::shared_ptr<const shadow::Geometry>& geometry,
                                         std::span<const scene::Light> lights, const ProgressSink& progress = {},
                                         const std::optional<Effort::Limits>& limits = {});

/// In square units of the scene.
[[nodiscard]] double areaOf(const Pieces& pieces, const Piece& piece);

struct LightAreas {
  double lit = 0.0, shadowed = 0.0;
};
/// Areas of surfaces, each triangle once: of its two sides the one that faces the light is meant.
struct Areas {
  double surface = 0.0;            ///< of the triangles as they were
  std::vector<LightAreas> lights;  ///< of the pieces
};
/// Per material of the scene.
/// 1. lit + shadowed is `surface` but for rounding, for every light.
[[nodiscard]] std::vector<Areas> areasByMaterial(const scene::Surfaces& surfaces, std::size_t materials,
                                                 const Pieces& pieces, std::size_t lights);
[[nodiscard]] Areas sum(std::span<const Areas> areas);

}  // namespace umbrage::cut
