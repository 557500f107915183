#pragma once

#include <cstdint>
#include <string>

namespace umbrage::gl {

/// What is known to be peculiar about a driver, found once per context. Every work-around in the program asks here.
struct Quirks {
  /// The rasteriser runs on the CPU: fill is dear, and the first frames compile shaders.
  bool software = false;
  /// llvmpipe's timer queries measure submission, not rasterisation (4.7 ms reported, 125 ms passed). Nothing here uses them:
  /// phases are timed by the wall clock between two finishes, which is right on every driver.
  bool timerQueriesMeasureSubmissionOnly = false;
  /// llvmpipe reads shader storage when it rasterises, not when it draws (22.3.6): contents that are replaced (Buffer::set) before are lost to draws that wait,
  /// which then see the new ones. Uniform buffers are safe. Whoever replaces storage between draws of one frame finishes first.
  bool readsStorageLate = false;
  /// Both faces of a triangle can be counted into the stencil in one pass. Every driver of OpenGL 4.5 says so; where it is not true, volumes are drawn
  /// twice with one face culled, which tests force (ContextOptions::adjust).
  bool twoSidedStencil = true;
  /// GL_EXT_depth_bounds_test: fragments can be left out by the depth that is stored where they fall. llvmpipe has it not.
  bool depthBounds = false;
  /// The largest buffer a shader may read; 128 MiB on llvmpipe, 2 GiB and more on GPUs.
  std::uint64_t maxStorageBytes = 0;
  /// The largest width and height of a target.
  int maxTextureSize = 0;
};

/// Of the current context.
[[nodiscard]] Quirks findQuirks();

/// "llvmpipe (LLVM 15.0.6, 256 bits)": the renderer string of the current context.
[[nodiscard]] std::string currentRenderer();

}  // namespace umbrage::gl
