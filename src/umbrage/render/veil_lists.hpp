#pragma once

#include <memory>

#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/pass.hpp"
#include "umbrage/render/gpu_frame.hpp"
#include "umbrage/render/gpu_scene.hpp"
#include "umbrage/shadow/veils.hpp"

namespace umbrage::render {

/// Of the stencil: set where a pixel has veils, by VeilLists::find(), and left alone by all that follows.
inline constexpr std::uint8_t kVeiledBit = 0x40;

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
  /// Draws them once, in any order, and sorts them. Clears the stencil, and marks where they are. Waits for how many they are.
  /// Errors: ErrorCode::device when memory is short, or a buffer of this driver too small for them.
  [[nodiscard]] Result<void> find(gl::HostScope& scope, const Input& input);
  /// There are none.
  void forget() { counts_ = {}; }

  [[nodiscard]] std::size_t count() const { return counts_.veils; }

  /// Per pixel, row by row from the bottom: where its veils begin, and how many they are.
  [[nodiscard]] const gl::Buffer& pixels() const { return pixels_; }
  /// Per veil: its triangle, with bit 31 where it shows its front; the bits of its depth.
  [[nodiscard]] const gl::Buffer& veils() const { return veils_; }

 private:
  struct Programs;
  struct Counts {
    std::uint32_t veils = 0, spilled = 0, most = 0, unused = 0;  // as the shaders have them
  };
  [[nodiscard]] Result<void> makeRoom(const Counts& counts);
  [[nodiscard]] Result<void> setRun(std::uint32_t run);
  void draw(gl::HostScope& scope, const Input& input);
  void drawLarge(gl::HostScope& scope, const Input& input);
  void eachPixel(gl::HostScope& scope, const Input& input, const gl::Program& program);
  void place(gl::HostScope& scope);
  [[nodiscard]] Result<void> sort(gl::HostScope& scope, const Input& input);

  std::unique_ptr<Programs> programs_;
  gl::Buffer lists_, countsBuffer_, slots_, spilled_, pixels_, veils_, merged_;
  gl::VertexArray screen_;
  Counts counts_;
  std::int32_t width_ = 0;
  std::uint32_t slotCount_ = 0;
};

}  // namespace umbrage::render
