#pragma once

#include <memory>

#include "umbrage/gl/pass_state.hpp"

namespace umbrage::gl {

/// How many binding points of each kind the house uses, from 0; HostScope saves these and no more.
inline constexpr int kUniformSlots = 3;
inline constexpr int kStorageSlots = 8;
inline constexpr int kTextureSlots = 5;

/// A crossing of the border between a host's OpenGL state and ours: saves everything that a PassState and our draws can touch,
/// sets the house baseline, and puts everything back at the end. Once per frame; also in contexts of our own.
/// REQUIRES: no transform feedback, conditional rendering or query is active (they would count our draws).
class HostScope {
 public:
  HostScope();
  HostScope(const HostScope&) = delete;
  HostScope& operator=(const HostScope&) = delete;
  ~HostScope();

  /// The host's draw framebuffer, as it was at the border.
  [[nodiscard]] unsigned hostFramebuffer() const;
  /// A baseline state that puts fragments where the host's own draws would: its first viewport, depth range and clip control.
  [[nodiscard]] PassState hostPlacement() const;
  /// Bits of the host's draw framebuffer; 0: it has none.
  [[nodiscard]] int hostStencilBits() const;
  [[nodiscard]] int hostDepthBits() const;

 private:
  friend class Pass;
  friend class Compute;
  struct State;
  [[nodiscard]] bool knowsDepthBounds() const;
  std::unique_ptr<State> state_;
  bool inPass_ = false;
};

}  // namespace umbrage::gl
