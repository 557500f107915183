#pragma once

#include <Inventor/SbViewportRegion.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoSeparator.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>

#include "umbrage/gl/context.hpp"
#include "umbrage/image/image.hpp"

// A window without a window: where Coin's scenes are drawn in tests and benchmarks.
namespace umbrage::coin::test {

/// Keeps a node of Coin.
struct Unref {
  void operator()(SoNode* node) const { node->unref(); }
};
template <class Node = SoSeparator>
using Ref = std::unique_ptr<Node, Unref>;
template <class Node>
Ref<Node> hold(Node* node) {
  node->ref();
  return Ref<Node>(node);
}

/// Starts Coin and this room, once.
void startCoin();

/// A scene from text without the header line; aborts the test where it cannot be read.
[[nodiscard]] Ref<> sceneOf(const std::string& text);

/// An OpenGL compatibility context of its own with a framebuffer. Current while it lives.
class Stage {
 public:
  /// Null where OpenGL is not to be had here.
  [[nodiscard]] static std::unique_ptr<Stage> make(int width, int height, bool stencil = true, int samples = 0);
  ~Stage();

  /// Draws as a viewer does: clears, then applies its action.
  image::RgbaImage draw(SoNode* scene);
  void clear();
  void apply(SoNode* scene);
  [[nodiscard]] image::RgbaImage picture() const;
  /// What the depth buffer holds, 0 at the near plane and 1 where nothing was drawn; row 0 at the top.
  [[nodiscard]] image::Image<float> depth() const;

  [[nodiscard]] SoGLRenderAction& action() { return action_; }
  [[nodiscard]] bool isSoftware() const { return context_->isSoftware(); }
  [[nodiscard]] const std::shared_ptr<gl::Context>& context() const { return context_; }
  /// Makes this one's context and framebuffer the current ones, where there are several.
  void enter();

 private:
  Stage(std::shared_ptr<gl::Context> context, int width, int height, bool stencil, int samples);
  std::shared_ptr<gl::Context> context_;
  std::unique_ptr<gl::CurrentContext> current_;
  int width_, height_;
  unsigned framebuffer_ = 0, buffers_[2] = {};
  unsigned resolved_ = 0, resolvedBuffer_ = 0;  ///< one sample a pixel, where the framebuffer has more
  SoGLRenderAction action_;
};

/// The largest difference of any channel, and where.
struct Difference {
  int most = 0, x = 0, y = 0;
  std::size_t pixels = 0;  ///< that differ by more than 2
};
/// Over pixels for which `where` is true.
template <class Where>
Difference largestDifference(const image::RgbaImage& a, const image::RgbaImage& b, Where&& where) {
  Difference found;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (!where(x, y)) continue;
      const auto &p = a(x, y), &q = b(x, y);
      const int most = std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
      found.pixels += most > 2;
      if (most > found.most) found.most = most, found.x = x, found.y = y;
    }
  }
  return found;
}

}  // namespace umbrage::coin::test
