#pragma once

#include <cstdint>
#include <memory>

#include "umbrage/gl/pass_state.hpp"

namespace umbrage::gl {

/// Lets a host's own draws through only where the stencil holds one value, inside a rectangle of the window; the stencil keeps its values. The host's
/// stencil test and scissor (its first) are put back at the end. A scissor that the host has on goes on cutting.
/// REQUIRES: an OpenGL 4.5 context is current, the same at the end; no HostScope in between.
class StencilWindow {
 public:
  StencilWindow(std::uint8_t value, const Rect& where);
  StencilWindow(const StencilWindow&) = delete;
  StencilWindow& operator=(const StencilWindow&) = delete;
  ~StencilWindow();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace umbrage::gl
