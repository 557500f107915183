#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace umbrage::gl {

/// Pixels, from the lower left of the target.
struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  friend bool operator==(const Rect&, const Rect&) = default;
};
[[nodiscard]] Rect intersect(const Rect& a, const Rect& b);

enum class Compare { never, less, lessOrEqual, equal, notEqual, greater, greaterOrEqual, always };
/// Counting wraps around, or stops at 255 and 0, as it did on all cards before 2002; replace: by the reference.
enum class StencilOp { keep, increment, decrement, replace, incrementToLimit, decrementToLimit };

struct DepthState {
  bool test = false;
  Compare pass = Compare::greater;
  bool write = false;
  bool clamp = true;  ///< nothing is clipped at the near and the far plane
  friend bool operator==(const DepthState&, const DepthState&) = default;
};

/// What happens to the stencil for one face. The stencil test's own failure always keeps.
struct StencilFace {
  StencilOp depthFail = StencilOp::keep;
  StencilOp pass = StencilOp::keep;
  friend bool operator==(const StencilFace&, const StencilFace&) = default;
};

struct StencilState {
  bool test = false;
  Compare compare = Compare::always;  ///< reference against stored value, both under readMask
  std::uint8_t reference = 0;
  std::uint8_t readMask = 0xff;
  std::uint8_t writeMask = 0xff;  ///< for clears too
  StencilFace front, back;
  friend bool operator==(const StencilState&, const StencilState&) = default;
};

enum class Blend { off, add, over };  ///< over: source is premultiplied by its alpha
enum class ClipDepth { minusOneToOne, zeroToOne };
enum class ClipOrigin { lowerLeft, upperLeft };

inline constexpr int kMostClipDistances = 2;

/// Everything that the fixed part of the pipeline needs to know for a pass: a plain value, applied as a whole.
/// A default value is the house baseline between passes.
struct PassState {
  DepthState depth;
  StencilState stencil;
  Blend blend = Blend::off;
  bool colourWrite = false;
  int colourTargets = 1;  ///< so many of the target's colour pictures are written, and blended, alike
  bool cullBack = false;
  bool frontIsClockwise = false;  ///< for views that mirror
  ClipDepth clipDepth = ClipDepth::zeroToOne;
  ClipOrigin clipOrigin = ClipOrigin::lowerLeft;
  std::array<float, 2> depthRange{0.0f, 1.0f};
  int clipDistances = 0;  ///< so many of gl_ClipDistance clip, from the first; at most kMostClipDistances
  Rect viewport;
  std::optional<Rect> scissor;  ///< none: the whole viewport
  /// Fragments that fall where the stored depth lies outside are left out, stencil and all. REQUIRES: Quirks::depthBounds; lowest first, within 0..1.
  std::optional<std::array<float, 2>> depthBounds;
  friend bool operator==(const PassState&, const PassState&) = default;
};

/// One line that names what differs from the baseline: "depth greater, clamp; stencil front fail-, back fail+; scissor 0 0 8 8".
[[nodiscard]] std::string describe(const PassState& state);

}  // namespace umbrage::gl
