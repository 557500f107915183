#pragma once

#include <memory>

#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/pass.hpp"
#include "umbrage/render/gpu_frame.hpp"
#include "umbrage/render/gpu_scene.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::render {

/// The veils before the opaque surfaces of a frame, on the graphics card: of each pixel all of them, sorted, the nearest first.
/// REQUIRES: its context is current when it is made, used and destroyed.
class VeilLists {
 public:
  VeilLists();
  ~VeilLists();

  struct Input {
    const GpuScene& scene;  ///< arranged apart
    const GpuFrame& frame;  ///< its opaque surfaces are drawn
    const gl::Buffer &view, &shading;
    gl::PassState placement;
  };
  /// Draws them once, in any order, and sorts them with compute shaders. Waits for how many they are.
  /// Errors: ErrorCode::device when memory is short, or a buffer of this driver too small for them.
  [[nodiscard]] Result<void> find(gl::HostScope& scope, const Input& input);
  /// There are none.
  void forget() { counts_ = {}; }

  [[nodiscard]] std::size_t count() const { return counts_.veils; }
  /// Of the pixel that has most.
  [[nodiscard]] std::size_t most() const { return counts_.most; }

  /// Per pixel, row by row from the bottom: where its veils begin, and how many they are.
  [[nodiscard]] const gl::Buffer& pixels() const { return pixels_; }
  /// Per veil: its triangle, with bit 31 where it shows its front; the bits of its depth.
  [[nodiscard]] const gl::Buffer& veils() const { return veils_; }

 private:
  struct Programs;
  struct Counts {
    std::uint32_t fragments = 0, veils = 0, most = 0, unused = 0;
  };
  void draw(gl::HostScope& scope, const Input& input);
  [[nodiscard]] Result<void> makeRoom(std::size_t fragments);
  void compute(gl::HostScope& scope, const gl::Program& program, std::size_t items);

  std::unique_ptr<Programs> programs_;
  gl::Buffer countsBuffer_, fragments_, pixels_, veils_;
  Counts counts_;
};

}  // namespace umbrage::render
