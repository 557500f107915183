#include "umbrage/gl/pass_state.hpp"

#include <algorithm>

namespace umbrage::gl {
namespace {

const char* name(Compare compare) {
  switch (compare) {
    case Compare::never: return "never";
    case Compare::less: return "less";
    case Compare::lessOrEqual: return "less-or-equal";
    case Compare::equal: return "equal";
    case Compare::notEqual: return "not-equal";
    case Compare::greater: return "greater";
    case Compare::greaterOrEqual: return "greater-or-equal";
    case Compare::always: return "always";
  }
  return "?";
}

const char* name(StencilOp op) {
  switch (op) {
    case StencilOp::keep: return "=";
    case StencilOp::increment: return "+";
    case StencilOp::decrement: return "-";
    case StencilOp::replace: return "!";
    case StencilOp::incrementToLimit: return "+|";
    case StencilOp::decrementToLimit: return "-|";
  }
  return "?";
}

std::string text(const DepthState& depth) {
  std::string out = depth.test ? std::string("depth ") + name(depth.pass) : "no depth test";
  if (depth.write) out += ", write";
  if (depth.clamp) out += ", clamp";
  return out;
}

std::string text(const StencilFace& face) {
  std::string out;
  if (face.depthFail != StencilOp::keep) out += std::string(" fail") + name(face.depthFail);
  if (face.pass != StencilOp::keep) out += std::string(" pass") + name(face.pass);
  return out.empty() ? " keep" : out;
}

std::string text(const StencilState& stencil) {
  if (!stencil.test) return {};
  std::string out = std::string("; stencil ") + name(stencil.compare);
  if (stencil.compare != Compare::always) out += " " + std::to_string(stencil.reference);
  if (stencil.readMask != 0xff) out += " of bits " + std::to_string(stencil.readMask);
  if (stencil.writeMask != 0xff) out += ", into bits " + std::to_string(stencil.writeMask);
  if (stencil.front == StencilFace{} && stencil.back == StencilFace{}) return out;
  return out + ", front" + text(stencil.front) + ", back" + text(stencil.back);
}

std::string text(const Rect& r) {
  return std::to_string(r.width) + "x" + std::to_string(r.height) + " at " + std::to_string(r.x) + "," +
         std::to_string(r.y);
}

}  // namespace

Rect intersect(const Rect& a, const Rect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const int right = std::min(a.x + a.width, b.x + b.width), top = std::min(a.y + a.height, b.y + b.height);
  return {x, y, std::max(0, right - x), std::max(0, top - y)};
}

std::string describe(const PassState& state) {
  std::string out = text(state.depth) + text(state.stencil);
  if (state.colourWrite) out += "; colour";
  if (state.colourTargets > 1) out += " in " + std::to_string(state.colourTargets) + " pictures";
  if (state.blend == Blend::add) out += " added";
  if (state.blend == Blend::over) out += " over";
  if (state.cullBack) out += "; back faces culled";
  if (state.frontIsClockwise) out += "; front is clockwise";
  if (state.clipDepth == ClipDepth::minusOneToOne) out += "; depth -1..1";
  if (state.depthRange != PassState{}.depthRange)
    out += "; depth range " + std::to_string(state.depthRange[0]) + ".." + std::to_string(state.depthRange[1]);
  if (state.clipOrigin == ClipOrigin::upperLeft) out += "; origin upper left";
  if (state.clipDistances != 0) out += "; " + std::to_string(state.clipDistances) + " clip distances";
  if (state.scissor) out += "; scissor " + text(*state.scissor);
  if (state.depthBounds)
    out += "; depth bounds " + std::to_string((*state.depthBounds)[0]) + ".." + std::to_string((*state.depthBounds)[1]);
  return out;
}

}  // namespace umbrage::gl
