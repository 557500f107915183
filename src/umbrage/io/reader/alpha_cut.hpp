#pragma once

#include <array>
#include <optional>
#include <vector>

#include "umbrage/io/reader/coverage.hpp"
#include "umbrage/math/vec.hpp"

namespace umbrage::io::reader {

/// How triangles are cut by what their texture says.
struct CutRule {
  bool decides =
      false;  ///< what covers half a cell is all there, what covers less is not (MASK); else it is there in part
  bool keepsEmpty = false;  ///< pieces of which nothing is there stay
  double factor = 1.0;      ///< to every value, where nothing is decided
  Wrap u = Wrap::repeat, v = Wrap::repeat;
};

/// A triangle with its corners' places on the texture: the whole of it is 0 to 1, v downwards. Places that are not finite, or
/// farther than 10^8 cells from the texture, count as none.
struct TexturedTriangle {
  std::array<Vec3, 3> corners;
  std::array<Vec2, 3> places;
};

/// Triangles, each of which is there to one part.
struct CutPieces {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<double> parts;  ///< per triangle, 0 to 1

  // What became of the triangles that were given:
  std::size_t dropped = 0;   ///< nothing of them is there
  std::size_t cut = 0;       ///< came in pieces
  std::size_t pieces = 0;    ///< in so many
  std::size_t unplaced = 0;  ///< take the whole texture's mean: they have no place on it
  double worstArea =
      0.0;  ///< where cells were decided: by how much of a triangle's area too much or too little is there
  double worstPart = 0.0;  ///< else: by how much a cell differs from its piece
};

/// Cuts triangles along the cells of a texture so that what is there becomes geometry, the same for every technique.
///
/// 1. At level 0 of a rule that decides, the pieces are exactly those parts of the triangles whose texels are there.
/// 2. Cells next to each other that are alike become one piece: rows of them, and rows upon each other. Pieces of one triangle
///    share their corners, bit by bit; so do those of two triangles along an edge with the same places.
/// 3. Where nothing is decided, cells that differ by at most 1/16 are alike, and their piece is there to their mean part.
///
/// `level`: of the coverage; from levels() on, triangles stay whole, by the mean of the texture. None where there are more than
/// `mostTriangles`, or where `effort`, from which every rectangle of cells that is looked at is taken (a microsecond or less), does not suffice.
[[nodiscard]] std::optional<CutPieces> cutByCoverage(const std::vector<TexturedTriangle>& triangles,
                                                     const Coverage& coverage, const CutRule& rule, std::size_t level,
                                                     std::size_t mostTriangles, std::size_t& effort);

/// So many cells must be looked at: what the time for cutting grows with.
[[nodiscard]] double cellsToLookAt(const std::vector<TexturedTriangle>& triangles, const Coverage& coverage,
                                   std::size_t level);

}  // namespace umbrage::io::reader
