#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "umbrage/coin/detail/ray_masks.hpp"
#include "umbrage/coin/detail/world.hpp"
#include "umbrage/coin/settings.hpp"
#include "umbrage/shadow/technique.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::coin::detail {

/// Masks of a view, one a light, with the technique that is asked for; what it has prepared for a world is kept until the world is another, and what
/// it has seen in a view until that is another.
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
  [[nodiscard]] Result<std::vector<shadow::LightMask>> masks(const World& world, const View& view,
                                                             std::span<const scene::Light> lights);
  /// Per pixel the triangle of the world that it shows, or shadow::kNoTriangle; good until the next call of any.
  /// REQUIRES, Errors: as masks().
  [[nodiscard]] Result<const image::Image<std::uint32_t>*> seen(const World& world, const View& view);
  /// Who made the last masks, as Umbrage names it.
  [[nodiscard]] const std::string& used() const { return used_; }
  /// Times what a view shows was found.
  [[nodiscard]] std::size_t views() const { return views_; }

 private:
  [[nodiscard]] Result<void> choose(Method method);
  [[nodiscard]] Result<void> prepareTechnique(const World& world);
  [[nodiscard]] Result<void> prepareRays(const World& world);
  [[nodiscard]] static bool needsRays(const World& world, const View& view);
  [[nodiscard]] Result<shadow::Shading> shade(const View& view, std::span<const scene::Light> lights,
                                              bool surfaceWanted);
  [[nodiscard]] Result<void> look(const World& world, const View& view);
  [[nodiscard]] Result<void> seeThrough(const World& world, const View& view, image::Image<std::uint32_t> triangle);
  [[nodiscard]] Result<void> repair(const View& view, std::span<const scene::Light> lights,
                                    std::vector<shadow::LightMask>& masks) const;
  [[nodiscard]] Result<std::vector<shadow::LightMask>> byRays(const View& view, std::span<const scene::Light> lights);
  void drop();

  /// What a view shows of a world.
  struct Sighting {
    std::shared_ptr<const shadow::Geometry> geometry;
    View view;
    image::Image<std::uint32_t> triangle;
    image::GreyImage missed;           ///< where a technique sees what is not drawn; empty: nowhere
    std::optional<SeenPoints> points;  ///< where rays see it: there, or, without a technique, everywhere
  };

  std::unique_ptr<shadow::Technique> technique_;
  std::optional<Method> chosen_;
  std::shared_ptr<const shadow::Geometry> prepared_;
  std::shared_ptr<const shadow::Geometry> traced_;
  std::optional<trace::Occlusion> occlusion_;
  std::optional<Sighting> sighting_;
  std::string used_;
  std::size_t views_ = 0;
};

}  // namespace umbrage::coin::detail
