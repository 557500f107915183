#pragma once

#include <optional>

#include "umbrage/math/vec.hpp"
#include "umbrage/shadow/planes.hpp"

namespace CLI {
class App;
}

namespace umbrage::cli {

/// What becomes of counts that 8 bits of stencil cannot hold.
enum class StencilCounter { exact, wrap, saturate };

/// What is asked of single techniques. It is nothing of OpenGL's, so that builds without it have it too.
struct TechniqueOptions {
  StencilCounter counter = StencilCounter::exact;  ///< of techniques that count in a stencil
  shadow::PlaneSearch planes;                      ///< of planar
  int mapTexels = 0;                               ///< of shadow maps, a side; 0: automatic
  int mapFilter = 1;                               ///< of shadow maps, in texels
  std::optional<Vec2> mapBias;  ///< of shadow maps, constant and by slope; none: as the technique has it
};
/// --stencil-counter, --planes, --plane, --map-size, --map-filter and --map-bias.
void addTechniqueOptions(CLI::App& app, TechniqueOptions& options);

}  // namespace umbrage::cli
