#include "umbrage/render/pass_list.hpp"

#include <array>

namespace umbrage::render {
namespace {

using gl::Compare;
using gl::StencilOp;

constexpr std::array kTargets{"surface", "tiles", "stencil", "mask", "sum", "picture", "host"};
constexpr std::array kDraws{
    "nothing",         "surfaces",        "surfaces that reach far", "casters through the near rectangle",
    "sides by z-pass", "sides by z-fail", "turned sides by z-fail",  "caps by z-fail",
    "the screen"};

Compare nearer(bool reversed) { return reversed ? Compare::greater : Compare::less; }

Shader shaderOf(const LightPlan& plan, Draw draw) {
  if (plan.extrusion == shadow::Extrusion::processor) return Shader::carriedVolume;
  if (plan.extrusion == shadow::Extrusion::geometryShader && draw != Draw::failCaps)
    return plan.finite ? Shader::finiteVolumeSides : Shader::volumeSides;
  return plan.finite ? Shader::finiteVolume : Shader::volume;
}

struct Planner {
  gl::PassState placement;
  bool reversed;
  Product product;
  PassList list;

  // A step in the frame's placement, with everything else at the baseline.
  PassStep step(std::string name, std::string phase, Target target) const {
    PassStep s;
    s.name = std::move(name);
    s.phase = std::move(phase);
    s.target = target;
    s.state = placement;
    return s;
  }

  void surfaces() {
    PassStep s = step("surfaces", "depth", Target::surface);
    s.shader = Shader::surface;
    s.draw = Draw::surfaces;
    s.clearColour = true;
    s.clearDepth = reversed ? 0.0f : 1.0f;
    s.state.colourWrite = true;
    s.state.depth = {.test = true, .pass = nearer(reversed), .write = true, .clamp = true};
    list.steps.push_back(s);
    s.name = "surfaces that reach far";
    s.shader = Shader::largeSurface;
    s.draw = Draw::largeSurfaces;
    s.clearColour = false;
    s.clearDepth.reset();
    list.steps.push_back(s);
  }

  Target stencilTarget() const { return product == Product::hostStencil ? Target::host : Target::stencil; }

  // Several groups of volumes take turns in the lower bits; the highest keeps what was in shadow before.
  static constexpr std::uint8_t kAllBits = 0xff, kCountBits = 0x7f, kKeepBit = 0x80;

  void startCount(int light, const LightPlan& plan, int group) {
    const std::uint8_t bits = plan.groups.size() > 1 ? kCountBits : kAllBits;
    PassStep s = step("start the count", "volumes", stencilTarget());
    s.light = light;
    s.group = group;
    s.clearStencil = static_cast<std::uint8_t>(plan.groups[static_cast<std::size_t>(group)].eyeCount & bits);
    if (group > 0) s.state.stencil.writeMask = bits;
    if (plan.litArea != placement.viewport) s.state.scissor = plan.litArea;
    list.steps.push_back(s);
  }

  // The volumes can only change the count inside their area, and only matter where the light arrives.
  void volume(int light, const LightPlan& plan, int group, Draw draw, const char* name, Compare pass,
              const gl::StencilFace& front, const gl::StencilFace& back) {
    const gl::Rect area = gl::intersect(plan.volumeArea, plan.litArea);
    if (area.empty()) return;
    PassStep s = step(name, "volumes", stencilTarget());
    s.light = light;
    s.group = group;
    s.shader = shaderOf(plan, draw);
    s.draw = draw;
    s.state.depth = {.test = true, .pass = pass, .write = false, .clamp = true};
    s.state.stencil = {.test = true, .compare = Compare::always, .front = front, .back = back};
    if (plan.groups.size() > 1) s.state.stencil.writeMask = kCountBits;
    if (area != placement.viewport) s.state.scissor = area;
    s.state.depthBounds = plan.depthBounds;
    if (plan.twoSided)
      list.steps.push_back(s);
    else
      oneFaceAtATime(s);
  }

  // What was the back face becomes the front face of the second pass.
  void oneFaceAtATime(PassStep s) {
    const gl::StencilFace back = s.state.stencil.back;
    s.state.cullBack = true;
    s.state.stencil.back = {};
    list.steps.push_back(s);
    s.state.frontIsClockwise = !s.state.frontIsClockwise;
    s.state.stencil.front = back;
    list.steps.push_back(s);
  }

  // Every surface counts one, whichever way it is wound.
  void nearCasters(int light, const LightPlan& plan, int group) {
    const gl::StencilFace up{.pass = StencilOp::increment};
    PassStep s = step("casters before the eye", "volumes", stencilTarget());
    s.light = light;
    s.group = group;
    s.shader = Shader::finiteVolume;
    s.draw = Draw::nearCasters;
    s.state.depth.clamp = false;
    s.state.stencil = {.test = true, .compare = Compare::always, .front = up, .back = up};
    if (plan.groups.size() > 1) s.state.stencil.writeMask = kCountBits;
    if (plan.litArea != placement.viewport) s.state.scissor = plan.litArea;
    list.steps.push_back(s);
  }

  void volumes(int light, const LightPlan& plan, int group) {
    if (plan.groups[static_cast<std::size_t>(group)].nearCasters) nearCasters(light, plan, group);
    if (plan.overflow != Overflow::saturates)
      return volumes(light, plan, group, StencilOp::increment, StencilOp::decrement);
    volumes(light, plan, group, StencilOp::incrementToLimit, StencilOp::keep);
    volumes(light, plan, group, StencilOp::keep, StencilOp::decrementToLimit);
  }

  void volumes(int light, const LightPlan& plan, int group, StencilOp up, StencilOp down) {
    const GroupPlan& parts = plan.groups[static_cast<std::size_t>(group)];
    const gl::StencilFace failUp{.depthFail = up}, failDown{.depthFail = down};
    const gl::StencilFace passUp{.pass = up}, passDown{.pass = down};
    if (parts.passSides) volume(light, plan, group, Draw::passSides, "sides", nearer(reversed), passUp, passDown);
    if (parts.failSides) volume(light, plan, group, Draw::failSides, "sides", nearer(reversed), failDown, failUp);
    if (parts.turnedSides)
      volume(light, plan, group, Draw::turnedSides, "turned sides", nearer(reversed), failUp, failDown);
    // Near caps lie on the casters and far caps at infinity: none is nearer than the picture, so all fail, without a
    // comparison that could fight with the surfaces they lie on.
    const Compare capsPass = plan.compareCaps ? nearer(reversed) : Compare::never;
    if (parts.failCaps) volume(light, plan, group, Draw::failCaps, "caps", capsPass, failDown, failUp);
  }

  void keepShadow(int light, const LightPlan& plan) {
    PassStep s = screen("keep the shadow", "volumes", stencilTarget(), Shader::keepShadow);
    s.light = light;
    s.state.colourWrite = false;
    const gl::StencilFace keep{.pass = StencilOp::replace};
    s.state.stencil = {.test = true,
                       .compare = Compare::notEqual,
                       .reference = kKeepBit,
                       .readMask = kCountBits,
                       .front = keep,
                       .back = keep};
    if (plan.litArea != placement.viewport) s.state.scissor = plan.litArea;
    list.steps.push_back(s);
  }

  void count(int light, const LightPlan& plan) {
    const int groups = static_cast<int>(plan.groups.size());
    for (int g = 0; g < groups; ++g) {
      startCount(light, plan, g);
      volumes(light, plan, g);
      if (g + 1 < groups) keepShadow(light, plan);
    }
  }

  PassStep screen(std::string name, std::string phase, Target target, Shader shader) const {
    PassStep s = step(std::move(name), std::move(phase), target);
    s.shader = shader;
    s.draw = Draw::screen;
    s.state.colourWrite = true;
    s.state.frontIsClockwise = false;
    return s;
  }

  void lit(int light, const LightPlan& plan) {
    PassStep s = product == Product::masks ? screen("mask", "lit", Target::mask, Shader::lightMask)
                                           : screen("light", "lit", Target::sum, Shader::light);
    s.light = light;
    if (product == Product::picture) s.state.blend = gl::Blend::add;
    s.state.stencil = {.test = true, .compare = Compare::equal, .reference = 0};
    if (plan.litArea != placement.viewport) s.state.scissor = plan.litArea;
    list.steps.push_back(s);
  }

  void clearMask(int light) {
    PassStep s = step("no light", "lit", Target::mask);
    s.light = light;
    s.clearColour = true;
    s.state.colourWrite = true;
    list.steps.push_back(s);
  }

  void ambient() {
    PassStep s = screen("ambient", "lit", Target::sum, Shader::ambient);
    s.clearColour = true;
    list.steps.push_back(s);
  }
};

std::string text(const PassStep& s) {
  std::string out = (s.light >= 0 ? "light " + std::to_string(s.light) + ": " : "") + s.name + " -> " +
                    kTargets[static_cast<std::size_t>(s.target)] + "\n";
  if (s.clearColour) out += "    clear colour\n";
  if (s.clearDepth) out += "    clear depth " + std::to_string(static_cast<int>(*s.clearDepth)) + "\n";
  if (s.clearStencil) out += "    clear stencil " + std::to_string(*s.clearStencil) + "\n";
  if (s.draw != Draw::nothing)
    out += std::string("    draw ") + kDraws[static_cast<std::size_t>(s.draw)] + ": " + describe(s.state) + "\n";
  else if (s.state.scissor)
    out += "    " + describe(s.state) + "\n";
  return out;
}

}  // namespace

std::string describe(const PassList& list) {
  std::string out;
  for (const PassStep& step : list.steps) out += text(step);
  return out;
}

PassList planSurfaces(const gl::PassState& placement, bool reversed) {
  Planner planner{placement, reversed, Product::masks, {}};
  planner.surfaces();
  return std::move(planner.list);
}

PassList planTiles(int light, const gl::Rect& tiles) {
  gl::PassState placement;
  placement.viewport = tiles;
  Planner planner{placement, true, Product::masks, {}};
  PassStep s = planner.screen("how far its receivers are", "tiles", Target::tiles, Shader::receiverTiles);
  s.light = light;
  return {{s}};
}

PassList planLights(const gl::PassState& placement, bool reversed, const std::vector<LightPlan>& lights,
                    Product product) {
  Planner planner{placement, reversed, product, {}};
  if (product == Product::picture) planner.ambient();
  for (int i = 0; i < static_cast<int>(lights.size()); ++i) {
    const LightPlan& plan = lights[static_cast<std::size_t>(i)];
    if (!plan.litArea.empty()) planner.count(i, plan);
    if (product == Product::masks) planner.clearMask(i);
    if (!plan.litArea.empty() && product != Product::hostStencil) planner.lit(i, plan);
  }
  if (product == Product::picture)
    planner.list.steps.push_back(planner.screen("encode", "lit", Target::picture, Shader::encode));
  return std::move(planner.list);
}

PassList planMask(const gl::PassState& placement, int light, const gl::Rect& litArea, std::uint8_t shadow) {
  Planner planner{placement, true, Product::masks, {}};
  planner.clearMask(light);
  if (litArea.empty()) return std::move(planner.list);
  planner.lit(light, {.volumeArea = {}, .litArea = litArea});
  planner.list.steps.back().state.stencil.readMask = shadow;
  return std::move(planner.list);
}

PassList planMaskedPicture(const gl::PassState& placement, int lights) {
  Planner planner{placement, true, Product::picture, {}};
  planner.ambient();
  for (int i = 0; i < lights; ++i) {
    PassStep s = planner.screen("light by its mask", "lit", Target::sum, Shader::maskedLight);
    s.light = i;
    s.state.blend = gl::Blend::add;
    planner.list.steps.push_back(s);
  }
  planner.list.steps.push_back(planner.screen("encode", "lit", Target::picture, Shader::encode));
  return std::move(planner.list);
}

}  // namespace umbrage::render
