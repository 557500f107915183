#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "umbrage/coin/detail/world.hpp"
#include "umbrage/coin/settings.hpp"
#include "umbrage/shadow/technique.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::coin::detail {

/// Which light reaches what.
struct Reach {
  image::Image<std::uint32_t> triangle;  ///< what each pixel sees; shadow::kNoTriangle: nothing
  std::vector<shadow::LightMask> masks;  ///< one a light
};

/// Masks of a view, one a light, with the technique that is asked for; what it has prepared for a world is kept until the world is another.
/// OpenGL's techniques run in a context of their own, in a thread of their own, so that the caller's current context is not touched whatever
/// made it (GLX and EGL do not share a thread).
class MaskMaker {
 public:
  MaskMaker();
  MaskMaker(const MaskMaker&) = delete;
  MaskMaker& operator=(const MaskMaker&) = delete;
  ~MaskMaker();

  /// Builds what the method needs for the world. Errors: ErrorCode::device when it cannot run here.
  [[nodiscard]] Result<void> prepare(const World& world, const View& view, Method method);
  /// REQUIRES: prepare() with the same succeeded. Errors: ErrorCode::device when memory runs out.
  [[nodiscard]] Result<Reach> masks(const World& world, const View& view, std::span<const scene::Light> lights);
  /// Who made the last masks, as Umbrage names it.
  [[nodiscard]] const std::string& used() const { return used_; }

 private:
  [[nodiscard]] Result<void> choose(Method method);
  [[nodiscard]] Result<void> prepareTechnique(const World& world);
  [[nodiscard]] Result<void> prepareRays(const World& world);
  [[nodiscard]] static bool needsRays(const World& world, const View& view);
  [[nodiscard]] Result<Reach> byTechnique(const View& view, std::span<const scene::Light> lights);
  [[nodiscard]] Result<void> seeThrough(const World& world, const View& view, std::span<const scene::Light> lights,
                                        Reach& reach);
  [[nodiscard]] Result<Reach> byRays(const World& world, const View& view, std::span<const scene::Light> lights);
  void drop();

  std::unique_ptr<shadow::Technique> technique_;
  std::optional<Method> chosen_;
  std::shared_ptr<const shadow::Geometry> prepared_;
  std::shared_ptr<const shadow::Geometry> traced_;
  std::optional<trace::Occlusion> occlusion_;
  std::string used_;
};

}  // namespace umbrage::coin::detail
