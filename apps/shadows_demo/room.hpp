#pragma once

class SoSeparator;

// Scenery made by code, so that the demo needs no file.
namespace umbrage::demo {

/// A floor and two walls, 16 units wide, 8 high, around where the objects stand. They receive shadows.
[[nodiscard]] SoSeparator* makeRoom();

/// A trefoil knot: a shape that casts onto itself.
[[nodiscard]] SoSeparator* makeKnot();

/// A table with a cone and a ball on it.
[[nodiscard]] SoSeparator* makeTable();

}  // namespace umbrage::demo
