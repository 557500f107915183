#pragma once

#include "umbrage/render/tinted_passes.hpp"
#include "umbrage/shadow/light_samples.hpp"

namespace umbrage::render {

/// The mean of what samples of one light let reach every surface of a frame, summed up on the graphics card; only an estimate of its error is read back.
/// What techniques/cpu has for the processor, in the same order: every other eight samples are one half.
/// REQUIRES: its context is current when it is made, used and destroyed.
class SoftSums {
 public:
  SoftSums();
  ~SoftSums();

  /// `shading`: of the frame, for the rays. `samples`: counted from 0 with every light.
  /// REQUIRES: `passes` has just reached the surfaces from `sample`. Errors: ErrorCode::device when memory is short.
  [[nodiscard]] Result<void> add(const TintedFrame& frame, const TintedPasses& passes, const gl::Buffer& shading,
                                 const shadow::LightSample& sample, const Vec3& eye);
  /// A light begins.
  void begin() { samples_ = 0; }
  [[nodiscard]] std::size_t samples() const { return samples_; }

  /// As SoftStats has it; infinite before both halves have samples. Waits for the driver. REQUIRES: the frame has tiles.
  [[nodiscard]] Result<double> error(const TintedFrame& frame);
  /// Writes it to passes.tints(). REQUIRES: there are samples.
  [[nodiscard]] Result<void> mean(const TintedFrame& frame, const TintedPasses& passes);

 private:
  struct Programs;
  struct Block;
  [[nodiscard]] Result<void> setBlock(const TintedFrame& frame, const Block& block);
  void bind(gl::Pass& pass, const TintedFrame& frame) const;

  std::unique_ptr<Programs> programs_;
  gl::Buffer block_, halves_;
  gl::VertexArray screen_;
  std::size_t samples_ = 0;
};

}  // namespace umbrage::render
