#include "umbrage/coin/detail/stamp.hpp"

#include <array>
#include <bit>
#include <cstring>

#include <umbrage_shaders/coin_screen_vert.hpp>
#include <umbrage_shaders/coin_stamp_frag.hpp>
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/pass.hpp"

namespace umbrage::coin::detail {
namespace {

/// As coin_stamp.frag has it.
struct PlaceBlock {
  std::int32_t x, y, width, bit;
};

std::vector<std::uint32_t> packed(const std::vector<std::uint8_t>& bytes) {
  static_assert(std::endian::native == std::endian::little);
  std::vector<std::uint32_t> words(bytes.size() / 4 + 1);
  std::memcpy(words.data(), bytes.data(), bytes.size());
  return words;
}

gl::PassState stampState(const gl::Rect& viewport, std::uint8_t bit) {
  gl::PassState state;
  state.viewport = viewport;
  state.stencil.test = true;
  state.stencil.reference = 0xff;
  state.stencil.writeMask = bit;
  state.stencil.front.pass = state.stencil.back.pass = gl::StencilOp::replace;
  return state;
}

}  // namespace

Stamp::Stamp() : program_(shaders::kCoinScreenVert, shaders::kCoinStampFrag) {}

void Stamp::clear(const gl::Rect& viewport) {
  gl::HostScope scope;
  gl::Pass pass(scope, scope.hostFramebuffer(), stampState(viewport, 0xff));
  pass.clearStencil(0);
}

Result<void> Stamp::write(const std::vector<std::uint8_t>& values, const gl::Rect& viewport) {
  clear(viewport);
  gl::HostScope scope;
  if (auto done = codes_.setAll(packed(values)); !done) return done;
  // One bit after the other: no fragment can choose the value that is written.
  std::uint8_t used = 0;
  for (const std::uint8_t value : values) used |= value;
  for (int bit = 1; bit < 256; bit *= 2) {
    if ((used & bit) == 0) continue;
    if (auto done = place_.setOne(PlaceBlock{viewport.x, viewport.y, viewport.width, bit}); !done) return done;
    gl::Pass pass(scope, scope.hostFramebuffer(), stampState(viewport, static_cast<std::uint8_t>(bit)));
    pass.use(program_);
    pass.uniforms(0, place_);
    pass.storage(0, codes_);
    pass.draw(nothing_, 3);
  }
  return {};
}

Result<void> checkTarget() {
  if (auto fine = gl::checkCurrentContext(); !fine) return fine;
  const gl::HostScope scope;
  if (scope.hostStencilBits() < 8) return fail(ErrorCode::device, "no shadows: the window has no 8 bits of stencil");
  if (scope.hostDepthBits() == 0) return fail(ErrorCode::device, "no shadows: the window has no depth");
  return {};
}

}  // namespace umbrage::coin::detail
