#pragma once

class SoNode;
class SoState;

namespace umbrage::coin::detail {

/// Which faces Coin has OpenGL leave out, by the way their corners go round on the screen; a transform that mirrors makes others of them.
enum class Culled { none, clockwise, counterclockwise };

/// Of a shape at this state. Asked before Coin enters it.
[[nodiscard]] Culled culledOf(SoState* state, const SoNode& shape);

}  // namespace umbrage::coin::detail
