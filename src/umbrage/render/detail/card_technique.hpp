#pragma once

#include <memory>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/host_scope.hpp"
#include "umbrage/render/technique.hpp"
#include "umbrage/shadow/phase_clock.hpp"

namespace umbrage::render::detail {

/// What the techniques on the graphics card share: their context, and the frame around the drawing of a picture.
class CardTechnique : public GlTechnique {
 public:
  CardTechnique(const shadow::Traits& traits, std::shared_ptr<gl::Context> context)
      : traits_(traits), context_(std::move(context)) {}

  [[nodiscard]] const shadow::Traits& traits() const final { return traits_; }

  [[nodiscard]] Result<shadow::FrameStats> draw(GpuFrame& target, const shadow::Frame& frame,
                                                const PictureOptions& options, bool timed) final {
    UMBRAGE_CHECK(geometry_ != nullptr, "prepare() first");
    UMBRAGE_CHECK(target.width() == frame.camera.width && target.height() == frame.camera.height, "picture size");
    const gl::CurrentContext current(context_);
    gl::HostScope scope;
    if (auto done = target.needPicture(); !done) return tl::unexpected(done.error());
    shadow::FrameStats stats;
    shadow::PhaseClock clock(stats.phases);
    PhaseEnd ended;
    if (timed) ended = [&](const char* phase) { clock.end(phase); };
    if (auto done = paint(scope, target, frame, options, stats, ended); !done) return tl::unexpected(done.error());
    return stats;
  }

 protected:
  /// Draws the picture; `ended` is empty where nobody wants times.
  [[nodiscard]] virtual Result<void> paint(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame,
                                           const PictureOptions& options, shadow::FrameStats& stats,
                                           const PhaseEnd& ended) = 0;

  shadow::Traits traits_;
  std::shared_ptr<gl::Context> context_;  ///< null: the caller's
  std::shared_ptr<const shadow::Geometry> geometry_;
};

}  // namespace umbrage::render::detail
