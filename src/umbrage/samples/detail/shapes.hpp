#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "umbrage/samples/detail/part.hpp"

namespace umbrage::samples::detail {

/// Points of one cross-section, counter-clockwise about the direction in which the shape runs; one point alone is an apex.
using Ring = std::vector<Vec3>;
/// A polygon in the plane, counter-clockwise, without repeated points.
using Outline = std::vector<Vec2>;

[[nodiscard]] Outline regular(int sides, double radius);
[[nodiscard]] Outline rectangle(double width, double height);

enum class Ends { closed, open, joined };  ///< capped; left open; the last ring joined to the first

/// A skin over cross-sections of equal length (or apexes). Caps are fans, so capped sections must be convex.
void addLoft(Part& part, std::span<const Ring> rings, Ends ends = Ends::closed);

/// An axis-parallel box.
void addBox(Part& part, const Vec3& min, const Vec3& max);

/// An outline (it may be concave) in the plane of `u` and `v` at `origin`, carried along `way`. REQUIRES: (u x v) . way > 0.
void addPrism(Part& part, const Outline& outline, const Vec3& origin, const Vec3& u, const Vec3& v, const Vec3& way);

/// A convex section carried along a path with mitred bends; x of the section is level where the path is not upright.
void addSweep(Part& part, std::span<const Vec3> path, const Outline& section, Ends ends = Ends::closed);

/// A straight strut of rectangular section.
void addBeam(Part& part, const Vec3& a, const Vec3& b, double width, double height);
inline void addBeam(Part& part, const Vec3& a, const Vec3& b, double size) { addBeam(part, a, b, size, size); }

/// A profile of (radius, height), from below upwards on the outside, turned about the upright axis through `centre`.
/// Radius 0 is an apex. Material per band: `bands[i]` between profile i and i+1, where given.
void addRevolved(Part& part, const Vec3& centre, const Outline& profile, int sides, Ends ends = Ends::closed,
                 std::span<const std::uint32_t> bands = {});

/// A lumpy ball: a subdivided icosahedron, `bumps` times its radius in and out.
void addBlob(Part& part, const Vec3& centre, const Vec3& radii, int subdivisions, double bumps);

/// One single-sided sheet.
void addSheet(Part& part, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// A body of cells: `fill` gives the material of a cell or nothing where it is empty, `corner` the place of a lattice point;
/// what is built is the boundary between full and empty, watertight whatever is cut out. i may run around (wrap).
struct Cells {
  int nx, ny, nz;
  std::function<std::optional<std::uint32_t>(int, int, int)> fill;
  std::function<Vec3(int, int, int)> corner;
  bool wrapX = false;
};
void addCells(Part& part, const Cells& cells);

/// A monotone curve through (key, value) pairs with flattened tangents (Fritsch and Carlson, 1980). REQUIRES: ascending keys.
[[nodiscard]] double interpolate(std::span<const Vec2> table, double key);

/// The sorted coordinates, each once.
[[nodiscard]] std::vector<double> sortedLines(std::vector<double> lines);

}  // namespace umbrage::samples::detail
