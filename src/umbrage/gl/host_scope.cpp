#include "umbrage/gl/host_scope.hpp"

#include <epoxy/gl.h>

#include <array>
#include <vector>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/objects.hpp"

namespace umbrage::gl {
namespace {

// Switches that must be off for our draws to mean what they say, whether or not a PassState names them.
constexpr std::array kSwitches{GL_DEPTH_TEST,
                               GL_DEPTH_CLAMP,
                               GL_STENCIL_TEST,
                               GL_CULL_FACE,
                               GL_COLOR_LOGIC_OP,
                               GL_POLYGON_OFFSET_FILL,
                               GL_POLYGON_OFFSET_LINE,
                               GL_POLYGON_OFFSET_POINT,
                               GL_FRAMEBUFFER_SRGB,
                               GL_MULTISAMPLE,
                               GL_SAMPLE_ALPHA_TO_ONE,
                               GL_SAMPLE_ALPHA_TO_COVERAGE,
                               GL_SAMPLE_COVERAGE,
                               GL_SAMPLE_SHADING,
                               GL_SAMPLE_MASK,
                               GL_PRIMITIVE_RESTART,
                               GL_RASTERIZER_DISCARD,
                               GL_PRIMITIVE_RESTART_FIXED_INDEX,
                               GL_DITHER,
                               GL_POLYGON_SMOOTH,
                               GL_LINE_SMOOTH,
                               GL_CLIP_DISTANCE0,
                               GL_CLIP_DISTANCE1,
                               GL_CLIP_DISTANCE2,
                               GL_CLIP_DISTANCE3,
                               GL_CLIP_DISTANCE4,
                               GL_CLIP_DISTANCE5,
                               GL_CLIP_DISTANCE6,
                               GL_CLIP_DISTANCE7};
// On at the baseline, as a new context has it: our targets have one sample, but a host's may have several.
constexpr std::array kOnSwitches{GL_MULTISAMPLE};
// These act on shaders' output in a compatibility context and do not exist in a core one.
constexpr std::array kCompatibilitySwitches{GL_ALPHA_TEST, GL_POLYGON_STIPPLE};
// With glEnablei and glDisablei, index 0 only: other viewports are the host's own business.
constexpr std::array kIndexedSwitches{GL_SCISSOR_TEST};

constexpr std::array kPackSettings{GL_PACK_SWAP_BYTES,  GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH,   GL_PACK_SKIP_ROWS,
                                   GL_PACK_SKIP_PIXELS, GL_PACK_ALIGNMENT, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES};
constexpr std::array kPackBaseline{0, 0, 0, 0, 0, 1, 0, 0};

GLint integer(GLenum what) {
  GLint value = 0;
  glGetIntegerv(what, &value);
  return value;
}

GLint integer(GLenum what, GLuint index) {
  GLint value = 0;
  glGetIntegeri_v(what, index, &value);
  return value;
}

void turn(GLenum what, bool on) { on ? glEnable(what) : glDisable(what); }
void turn(GLenum what, GLuint index, bool on) { on ? glEnablei(what, index) : glDisablei(what, index); }

bool isCompatibilityContext() { return (integer(GL_CONTEXT_PROFILE_MASK) & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0; }

// A buffer bound to a numbered point, whole or in part.
struct Binding {
  GLuint buffer = 0;
  GLint64 start = 0, size = 0;
};

Binding binding(GLuint slot, GLenum buffer, GLenum start, GLenum size) {
  Binding b;
  b.buffer = static_cast<GLuint>(integer(buffer, slot));
  glGetInteger64i_v(start, slot, &b.start);
  glGetInteger64i_v(size, slot, &b.size);
  return b;
}

void bind(GLenum target, GLuint slot, const Binding& b) {
  if (b.buffer == 0 || b.size == 0)  // size 0: bound whole, or nothing bound
    glBindBufferBase(target, slot, b.buffer);
  else
    glBindBufferRange(target, slot, b.buffer, static_cast<GLintptr>(b.start), static_cast<GLsizeiptr>(b.size));
}

struct StencilFaceState {
  GLint func, reference, valueMask, writeMask, fail, depthFail, pass;
};

StencilFaceState stencilFront() {
  return {integer(GL_STENCIL_FUNC),           integer(GL_STENCIL_REF),  integer(GL_STENCIL_VALUE_MASK),
          integer(GL_STENCIL_WRITEMASK),      integer(GL_STENCIL_FAIL), integer(GL_STENCIL_PASS_DEPTH_FAIL),
          integer(GL_STENCIL_PASS_DEPTH_PASS)};
}

StencilFaceState stencilBack() {
  return {integer(GL_STENCIL_BACK_FUNC),           integer(GL_STENCIL_BACK_REF),
          integer(GL_STENCIL_BACK_VALUE_MASK),     integer(GL_STENCIL_BACK_WRITEMASK),
          integer(GL_STENCIL_BACK_FAIL),           integer(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
          integer(GL_STENCIL_BACK_PASS_DEPTH_PASS)};
}

void set(GLenum face, const StencilFaceState& s) {
  glStencilFuncSeparate(face, static_cast<GLenum>(s.func), s.reference, static_cast<GLuint>(s.valueMask));
  glStencilMaskSeparate(face, static_cast<GLuint>(s.writeMask));
  glStencilOpSeparate(face, static_cast<GLenum>(s.fail), static_cast<GLenum>(s.depthFail), static_cast<GLenum>(s.pass));
}

struct BlendState {
  GLint sourceRgb, targetRgb, sourceAlpha, targetAlpha, equationRgb, equationAlpha;
};

// What becomes of what is drawn into one colour picture.
struct ColourState {
  GLboolean isBlended = GL_FALSE;
  BlendState blend{};
  std::array<GLboolean, 4> mask{};
};

ColourState colourState(GLuint i) {
  ColourState state;
  state.isBlended = glIsEnabledi(GL_BLEND, i);
  state.blend = {integer(GL_BLEND_SRC_RGB, i),      integer(GL_BLEND_DST_RGB, i),
                 integer(GL_BLEND_SRC_ALPHA, i),    integer(GL_BLEND_DST_ALPHA, i),
                 integer(GL_BLEND_EQUATION_RGB, i), integer(GL_BLEND_EQUATION_ALPHA, i)};
  glGetBooleani_v(GL_COLOR_WRITEMASK, i, state.mask.data());
  return state;
}

void set(GLuint i, const ColourState& s) {
  const auto e = [](GLint v) { return static_cast<GLenum>(v); };
  const BlendState& b = s.blend;
  turn(GL_BLEND, i, s.isBlended == GL_TRUE);
  glBlendFuncSeparatei(i, e(b.sourceRgb), e(b.targetRgb), e(b.sourceAlpha), e(b.targetAlpha));
  glBlendEquationSeparatei(i, e(b.equationRgb), e(b.equationAlpha));
  glColorMaski(i, s.mask[0], s.mask[1], s.mask[2], s.mask[3]);
}

int attachmentBits(GLuint framebuffer, GLenum ofWindow, GLenum ofFramebuffer, GLenum what) {
  const GLenum attachment = framebuffer == 0 ? ofWindow : ofFramebuffer;
  GLint type = GL_NONE, bits = 0;
  glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, &type);
  if (type != GL_NONE) glGetNamedFramebufferAttachmentParameteriv(framebuffer, attachment, what, &bits);
  return bits;
}

}  // namespace

struct HostScope::State {
  bool compatibility = isCompatibilityContext();
  bool knowsDepthBounds = epoxy_has_gl_extension("GL_EXT_depth_bounds_test");
  GLboolean depthBoundsTest = GL_FALSE;
  std::array<GLdouble, 2> depthBounds{};
  std::array<GLboolean, kSwitches.size()> switches{};
  std::array<GLboolean, kCompatibilitySwitches.size()> compatibilitySwitches{};
  std::array<GLboolean, kIndexedSwitches.size()> indexedSwitches{};
  std::array<GLint, kPackSettings.size()> pack{};
  std::array<Binding, kUniformSlots> uniforms;
  std::array<Binding, kStorageSlots> storages;
  std::array<GLint, kTextureSlots> textures{}, samplers{};

  GLint program = integer(GL_CURRENT_PROGRAM);
  GLint pipeline = integer(GL_PROGRAM_PIPELINE_BINDING);
  GLint vertexArray = integer(GL_VERTEX_ARRAY_BINDING);
  GLint uniformBuffer = integer(GL_UNIFORM_BUFFER_BINDING);
  GLint storageBuffer = integer(GL_SHADER_STORAGE_BUFFER_BINDING);
  GLint packBuffer = integer(GL_PIXEL_PACK_BUFFER_BINDING);
  GLint indirectBuffer = integer(GL_DRAW_INDIRECT_BUFFER_BINDING);
  GLint drawFramebuffer = integer(GL_DRAW_FRAMEBUFFER_BINDING);
  GLint readFramebuffer = integer(GL_READ_FRAMEBUFFER_BINDING);

  std::array<GLfloat, 4> viewport{};
  std::array<GLint, 4> scissor{};
  std::array<GLdouble, 2> depthRange{};
  std::array<ColourState, kColourTargets> colours;
  std::array<GLint, 2> polygonMode{};
  GLint depthFunc = integer(GL_DEPTH_FUNC);
  GLboolean depthMask = GL_TRUE;
  StencilFaceState front = stencilFront(), back = stencilBack();
  GLint cullFace = integer(GL_CULL_FACE_MODE);
  GLint frontFace = integer(GL_FRONT_FACE);
  GLint clipOrigin = integer(GL_CLIP_ORIGIN);
  GLint clipDepth = integer(GL_CLIP_DEPTH_MODE);
  GLint clampRead = integer(GL_CLAMP_READ_COLOR);
  GLint provokingVertex = integer(GL_PROVOKING_VERTEX);

  State();
  void restore() const;
  void restoreBindings() const;
  void restoreFixedFunctions() const;
};

HostScope::State::State() {
  for (std::size_t i = 0; i < switches.size(); ++i) switches[i] = glIsEnabled(kSwitches[i]);
  if (compatibility)
    for (std::size_t i = 0; i < compatibilitySwitches.size(); ++i)
      compatibilitySwitches[i] = glIsEnabled(kCompatibilitySwitches[i]);
  for (std::size_t i = 0; i < indexedSwitches.size(); ++i) indexedSwitches[i] = glIsEnabledi(kIndexedSwitches[i], 0);
  for (std::size_t i = 0; i < pack.size(); ++i) pack[i] = integer(kPackSettings[i]);
  for (GLuint i = 0; i < uniforms.size(); ++i)
    uniforms[i] = binding(i, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE);
  for (GLuint i = 0; i < storages.size(); ++i)
    storages[i] =
        binding(i, GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE);
  for (GLuint i = 0; i < textures.size(); ++i) {
    textures[i] = integer(GL_TEXTURE_BINDING_2D, i);
    samplers[i] = integer(GL_SAMPLER_BINDING, i);
  }
  glGetFloati_v(GL_VIEWPORT, 0, viewport.data());
  glGetIntegeri_v(GL_SCISSOR_BOX, 0, scissor.data());
  glGetDoublei_v(GL_DEPTH_RANGE, 0, depthRange.data());
  for (GLuint i = 0; i < colours.size(); ++i) colours[i] = colourState(i);
  glGetIntegerv(GL_POLYGON_MODE, polygonMode.data());
  glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask);
  if (!knowsDepthBounds) return;
  depthBoundsTest = glIsEnabled(GL_DEPTH_BOUNDS_TEST_EXT);
  glGetDoublev(GL_DEPTH_BOUNDS_EXT, depthBounds.data());
}

void HostScope::State::restoreBindings() const {
  glUseProgram(static_cast<GLuint>(program));
  glBindProgramPipeline(static_cast<GLuint>(pipeline));
  glBindVertexArray(static_cast<GLuint>(vertexArray));
  for (GLuint i = 0; i < uniforms.size(); ++i) bind(GL_UNIFORM_BUFFER, i, uniforms[i]);
  for (GLuint i = 0; i < storages.size(); ++i) bind(GL_SHADER_STORAGE_BUFFER, i, storages[i]);
  // Binding to a numbered point also binds to the target itself, so these come last.
  glBindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(uniformBuffer));
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(storageBuffer));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(packBuffer));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, static_cast<GLuint>(indirectBuffer));
  const auto active = static_cast<GLenum>(integer(GL_ACTIVE_TEXTURE));
  for (GLuint i = 0; i < textures.size(); ++i) {
    // glBindTextureUnit(unit, 0) would unbind every target of the unit, so the 2D target is named.
    glActiveTexture(GL_TEXTURE0 + i);
    glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(textures[i]));
    glBindSampler(i, static_cast<GLuint>(samplers[i]));
  }
  glActiveTexture(active);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawFramebuffer));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(readFramebuffer));
}

void HostScope::State::restoreFixedFunctions() const {
  for (std::size_t i = 0; i < switches.size(); ++i) turn(kSwitches[i], switches[i] == GL_TRUE);
  if (compatibility)
    for (std::size_t i = 0; i < compatibilitySwitches.size(); ++i)
      turn(kCompatibilitySwitches[i], compatibilitySwitches[i] == GL_TRUE);
  for (std::size_t i = 0; i < indexedSwitches.size(); ++i) turn(kIndexedSwitches[i], 0, indexedSwitches[i] == GL_TRUE);
  for (std::size_t i = 0; i < pack.size(); ++i) glPixelStorei(kPackSettings[i], pack[i]);
  glViewportIndexedf(0, viewport[0], viewport[1], viewport[2], viewport[3]);
  glScissorIndexed(0, scissor[0], scissor[1], scissor[2], scissor[3]);
  glDepthRangeIndexed(0, depthRange[0], depthRange[1]);
  for (GLuint i = 0; i < colours.size(); ++i) set(i, colours[i]);
  if (compatibility && polygonMode[0] != polygonMode[1]) {
    glPolygonMode(GL_FRONT, static_cast<GLenum>(polygonMode[0]));
    glPolygonMode(GL_BACK, static_cast<GLenum>(polygonMode[1]));
  } else {
    glPolygonMode(GL_FRONT_AND_BACK, static_cast<GLenum>(polygonMode[0]));
  }
  glDepthFunc(static_cast<GLenum>(depthFunc));
  glDepthMask(depthMask);
  if (knowsDepthBounds) {
    turn(GL_DEPTH_BOUNDS_TEST_EXT, depthBoundsTest == GL_TRUE);
    glDepthBoundsEXT(depthBounds[0], depthBounds[1]);
  }
  set(GL_FRONT, front);
  set(GL_BACK, back);
  glCullFace(static_cast<GLenum>(cullFace));
  glFrontFace(static_cast<GLenum>(frontFace));
  glClipControl(static_cast<GLenum>(clipOrigin), static_cast<GLenum>(clipDepth));
  glClampColor(GL_CLAMP_READ_COLOR, static_cast<GLenum>(clampRead));
  glProvokingVertex(static_cast<GLenum>(provokingVertex));
}

void HostScope::State::restore() const {
  restoreBindings();
  restoreFixedFunctions();
}

HostScope::HostScope() : state_(std::make_unique<State>()) {
  // What no PassState names is set here, once; the rest by every Pass.
  for (const GLenum what : kSwitches) glDisable(what);
  for (const GLenum what : kOnSwitches) glEnable(what);
  if (state_->compatibility)
    for (const GLenum what : kCompatibilitySwitches) glDisable(what);
  for (std::size_t i = 0; i < kPackSettings.size(); ++i) glPixelStorei(kPackSettings[i], kPackBaseline[i]);
  for (GLuint i = 0; i < kTextureSlots; ++i) glBindSampler(i, 0);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glCullFace(GL_BACK);
  glClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
  // It decides at which corner llvmpipe starts a triangle's plane equations, and with it the last bits of depth.
  glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glBindProgramPipeline(0);
}

HostScope::~HostScope() {
  UMBRAGE_CHECK(!inPass_, "a pass outlives its host scope");
  state_->restore();
}

bool HostScope::knowsDepthBounds() const { return state_->knowsDepthBounds; }

unsigned HostScope::hostFramebuffer() const { return static_cast<unsigned>(state_->drawFramebuffer); }

int HostScope::hostStencilBits() const {
  return attachmentBits(hostFramebuffer(), GL_STENCIL, GL_STENCIL_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE);
}

int HostScope::hostDepthBits() const {
  return attachmentBits(hostFramebuffer(), GL_DEPTH, GL_DEPTH_ATTACHMENT, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
}

PassState HostScope::hostPlacement() const {
  PassState state;
  const auto& v = state_->viewport;
  state.viewport = {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]), static_cast<int>(v[3])};
  state.depthRange = {static_cast<float>(state_->depthRange[0]), static_cast<float>(state_->depthRange[1])};
  state.clipDepth = state_->clipDepth == GL_ZERO_TO_ONE ? ClipDepth::zeroToOne : ClipDepth::minusOneToOne;
  state.clipOrigin = state_->clipOrigin == GL_UPPER_LEFT ? ClipOrigin::upperLeft : ClipOrigin::lowerLeft;
  return state;
}

}  // namespace umbrage::gl
