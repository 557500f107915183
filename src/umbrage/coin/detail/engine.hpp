#pragma once

#include <functional>
#include <optional>

#include "umbrage/coin/detail/extractor.hpp"
#include "umbrage/coin/detail/mask_maker.hpp"
#include "umbrage/coin/detail/registry.hpp"
#include "umbrage/coin/detail/subsets.hpp"
#include "umbrage/coin/detail/volumes.hpp"
#include "umbrage/coin/detail/world_builder.hpp"
#include "umbrage/coin/settings.hpp"
#include "umbrage/coin/shadow_report.hpp"
#include "umbrage/shadow/phase_clock.hpp"

class SoGLRenderAction;
class SoPath;
class SoSeparator;
class SoState;

namespace umbrage::coin::detail {

/// What becomes of shapes that Coin puts off until all others are drawn: their paths are noted, or noted as leading through a child that the group
/// does not have, so that they are drawn once however many passes there are. (Coin dies of a path that it has twice.)
enum class Delayed { noted, astray };
inline constexpr int kNoChild = 1 << 20;  ///< index of that child
[[nodiscard]] SoNode* nobody();           ///< the child

/// What one picture of a scene graph needs to know about its shadows: the one implementation behind node and manager.
class Engine {
 public:
  /// Draws the shapes once, as Coin does. What it does to the state, the caller takes back.
  using Draw = std::function<void(SoGLRenderAction*)>;

  explicit Engine(Registry registry) : registry_(std::move(registry)) {}

  /// Draws with shadows, or, where that cannot be, once as Coin does; then error() says why.
  void render(SoGLRenderAction* action, const Settings& settings, const Draw& draw);

  /// The volumes of the graph at the end of a path, in the coordinates of the path's head, without a picture: for what is written to files.
  /// Null where there is none; it belongs to this until the next call.
  [[nodiscard]] SoSeparator* volumesOf(const SoPath& path, const Settings& settings);
  [[nodiscard]] Extractor& extractor() { return extractor_; }

  [[nodiscard]] Registry& registry() { return registry_; }
  [[nodiscard]] const Work& work() const { return work_; }
  [[nodiscard]] Work& work() { return work_; }
  [[nodiscard]] const ShadowReport& report();
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  [[nodiscard]] Result<void> drawShadowed(SoGLRenderAction* action, const Settings& settings, const Draw& draw);
  void drawVolumes(SoGLRenderAction* action, const Scan& scan, const Sight& sight, const Settings& settings);
  [[nodiscard]] Result<void> shade(const Scan& scan, const View& view, const Settings& settings,
                                   shadow::PhaseClock& clock);
  [[nodiscard]] Result<void> shadowsOf(const Scan& scan, const std::optional<View>& view, const Settings& settings,
                                       shadow::PhaseClock& clock);
  [[nodiscard]] Result<void> compose(SoGLRenderAction* action, const std::optional<View>& view, const Draw& draw,
                                     shadow::PhaseClock& clock);
  void drawSubset(SoGLRenderAction* action, const Subset* subset, std::uint8_t stencil, const gl::Rect& whole,
                  const Draw& draw, Delayed delayed);
  [[nodiscard]] static Result<void> complaints(const Scan& scan);
  void forgetShadows();

  Registry registry_;
  Extractor extractor_;
  WorldBuilder builder_;
  MaskMaker masks_;
  VolumeMaker volumes_;
  Work work_;
  std::optional<Error> error_;
  // The last shadows, and what they were made for:
  std::shared_ptr<const shadow::Geometry> geometry_;
  std::optional<View> view_;
  std::optional<Method> method_;
  std::vector<Vec4> places_;              ///< of the lights, homogeneous
  std::vector<shadow::LightMask> reach_;  ///< whatever the lights' cones
  std::optional<Subsets> subsets_;        ///< of it, once they are found; none: everything is lit
  std::vector<std::uint64_t> shining_;    ///< what they were found for
  // What is told of them, made when asked for:
  std::vector<PlacedLight> lights_;
  std::size_t passes_ = 0;
  std::vector<shadow::PhaseTime> phases_;
  ShadowReport report_;
  bool reportIsOld_ = false;
};

}  // namespace umbrage::coin::detail
