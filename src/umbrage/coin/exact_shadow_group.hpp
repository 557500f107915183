#pragma once

#include <Inventor/fields/SoSFBool.h>
#include <Inventor/fields/SoSFEnum.h>
#include <Inventor/fields/SoSFFloat.h>
#include <Inventor/nodes/SoSeparator.h>

#include <memory>

#include "umbrage/base/error.hpp"
#include "umbrage/coin/settings.hpp"
#include "umbrage/coin/shadow_report.hpp"

namespace umbrage::coin {

namespace detail {
class Engine;
}

/// Makes the nodes of this room known to Coin, so that files may name them. Once, after SoDB::init(); more often does no harm.
void init();

/// A separator in which every light casts exact shadows of every shape: put the lights and the shapes inside. The camera may stand
/// before it or inside.
///
/// 1. Every pixel of a surface is Coin's own picture with exactly those lights on that reach its surface: where all do, it is Coin's picture to the bit;
///    materials, textures, fog and shaders are as the user set them. Lines and points show the shadows of what is behind them.
/// 2. Whatever changes in the scene graph shows in the next picture, with no call; only what changed is worked out anew (work()).
/// 3. Shapes that Coin puts off until all others are drawn (transparent ones, by most types of transparency, and annotations) are drawn once, then, and in
///    full light.
/// 4. The OpenGL state is given back as Coin's own traversal leaves it, but for the stencil buffer inside the viewport, which is used and left at 0.
/// Where shadows cannot be drawn (OpenGL older than 4.5, no stencil, inside another such node, whose shadows all shapes have) the scene is drawn
/// as a separator draws it, and lastError() says why.
///
/// In files: `ExactShadowGroup { method AUTOMATIC .. }`. Several viewers may show one scene.
/// CAVEAT: lights before the node shine everywhere. OpenGL's limit of lights (mostly 8) is Coin's. A light node that stands at several places casts
/// no shadows, and lastError() says so. What the camera's near plane cuts off casts and hides all the same.
class SoExactShadowGroup : public SoSeparator {
  typedef SoSeparator inherited;
  SO_NODE_HEADER(SoExactShadowGroup);

 public:
  static void initClass();
  SoExactShadowGroup();

  enum ShadowMethod { AUTOMATIC, Z_PASS, Z_FAIL, RAY_TRACED };
  enum TransparentCasting { NONE, OPAQUE };

  SoSFBool isActive;            ///< FALSE: an ordinary separator
  SoSFEnum method;              ///< ShadowMethod; AUTOMATIC
  SoSFEnum transparentCasters;  ///< TransparentCasting; NONE
  SoSFBool showVolumes;         ///< shadow volumes are drawn translucent over the scene
  SoSFFloat volumeDepth;        ///< how far shown volumes reach, in scene units; 0: to infinity

  [[nodiscard]] const Work& work() const;
  /// Of the last picture.
  [[nodiscard]] const ShadowReport& report() const;
  /// Why the last picture has no shadows, or not all of them.
  [[nodiscard]] const std::optional<Error>& lastError() const;

  void GLRenderBelowPath(SoGLRenderAction* action) override;
  void GLRenderInPath(SoGLRenderAction* action) override;
  void getBoundingBox(SoGetBoundingBoxAction* action) override;
  void getMatrix(SoGetMatrixAction* action) override;

  /// For the other files of this room.
  [[nodiscard]] detail::Engine& engine() { return *engine_; }
  [[nodiscard]] Settings settings() const;  ///< what the fields say

 protected:
  ~SoExactShadowGroup() override;

 private:
  std::unique_ptr<detail::Engine> engine_;
};

}  // namespace umbrage::coin
