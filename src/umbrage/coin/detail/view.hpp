#pragma once

#include <optional>

#include "umbrage/math/vec.hpp"
#include "umbrage/scene/camera.hpp"

namespace umbrage::coin::detail {

struct Sight;

/// What the pixels of a viewport see: any view that OpenGL's matrices can say, also parallel, shifted (stereo, tiles) and stretched ones.
struct View {
  int x = 0, y = 0;  ///< of the viewport's lower left corner in the window
  int width = 0, height = 0;
  Mat4 toClip{1.0}, fromClip{1.0};  ///< between the world and OpenGL's clip coordinates
  Vec4 eye{0.0};  ///< homogeneous, in the world; w = 0: a parallel view, and the direction towards the eye
  std::optional<scene::Camera> pinhole;  ///< the same view, where a camera with square pixels around its axis is one

  friend bool operator==(const View& a, const View& b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height && a.toClip == b.toClip;
  }
};

/// None when the matrices cannot be inverted or the viewport is empty.
[[nodiscard]] std::optional<View> viewOf(const Sight& sight);

/// From the near plane through a point of the picture to the far plane, in the world; pixel (i, j) has its centre at (i + 0.5, j + 0.5), and row 0
/// is the top.
struct ViewRay {
  Vec3 from, direction;
};
[[nodiscard]] ViewRay rayThrough(const View& view, double x, double y);

}  // namespace umbrage::coin::detail
