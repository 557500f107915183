#include "state/host_state.hpp"

#include <epoxy/gl.h>

#include <array>
#include <sstream>
#include <utility>

namespace umbrage::state {
namespace {

struct Named {
  GLenum what;
  const char* name;
};
#define UMBRAGE_NAMED(what) \
  Named { what, #what }

// More of each kind than the house uses, so that touching a neighbour would be seen.
constexpr int kSlots = 10, kUnits = 12, kDrawBuffers = 8, kViewports = 3;

const std::vector<Named> kSwitches{UMBRAGE_NAMED(GL_DEPTH_TEST),
                                   UMBRAGE_NAMED(GL_DEPTH_CLAMP),
                                   UMBRAGE_NAMED(GL_STENCIL_TEST),
                                   UMBRAGE_NAMED(GL_CULL_FACE),
                                   UMBRAGE_NAMED(GL_COLOR_LOGIC_OP),
                                   UMBRAGE_NAMED(GL_POLYGON_OFFSET_FILL),
                                   UMBRAGE_NAMED(GL_POLYGON_OFFSET_LINE),
                                   UMBRAGE_NAMED(GL_POLYGON_OFFSET_POINT),
                                   UMBRAGE_NAMED(GL_FRAMEBUFFER_SRGB),
                                   UMBRAGE_NAMED(GL_MULTISAMPLE),
                                   UMBRAGE_NAMED(GL_SAMPLE_ALPHA_TO_ONE),
                                   UMBRAGE_NAMED(GL_SAMPLE_ALPHA_TO_COVERAGE),
                                   UMBRAGE_NAMED(GL_SAMPLE_COVERAGE),
                                   UMBRAGE_NAMED(GL_SAMPLE_SHADING),
                                   UMBRAGE_NAMED(GL_SAMPLE_MASK),
                                   UMBRAGE_NAMED(GL_PRIMITIVE_RESTART),
                                   UMBRAGE_NAMED(GL_RASTERIZER_DISCARD),
                                   UMBRAGE_NAMED(GL_PRIMITIVE_RESTART_FIXED_INDEX),
                                   UMBRAGE_NAMED(GL_DITHER),
                                   UMBRAGE_NAMED(GL_POLYGON_SMOOTH),
                                   UMBRAGE_NAMED(GL_LINE_SMOOTH),
                                   UMBRAGE_NAMED(GL_PROGRAM_POINT_SIZE),
                                   UMBRAGE_NAMED(GL_CLIP_DISTANCE0),
                                   UMBRAGE_NAMED(GL_CLIP_DISTANCE3),
                                   UMBRAGE_NAMED(GL_CLIP_DISTANCE7),
                                   UMBRAGE_NAMED(GL_TEXTURE_CUBE_MAP_SEAMLESS)};
const std::vector<Named> kCompatibilitySwitches{UMBRAGE_NAMED(GL_ALPHA_TEST), UMBRAGE_NAMED(GL_POLYGON_STIPPLE),
                                                UMBRAGE_NAMED(GL_LIGHTING),   UMBRAGE_NAMED(GL_FOG),
                                                UMBRAGE_NAMED(GL_NORMALIZE),  UMBRAGE_NAMED(GL_LINE_STIPPLE)};

struct Wide {
  GLenum what;
  const char* name;
  int count;
};
#define UMBRAGE_WIDE(what, count) \
  Wide { what, #what, count }

const std::vector<Wide> kValues{UMBRAGE_WIDE(GL_DEPTH_FUNC, 1),
                                UMBRAGE_WIDE(GL_DEPTH_WRITEMASK, 1),
                                UMBRAGE_WIDE(GL_DEPTH_CLEAR_VALUE, 1),
                                UMBRAGE_WIDE(GL_STENCIL_CLEAR_VALUE, 1),
                                UMBRAGE_WIDE(GL_COLOR_CLEAR_VALUE, 4),
                                UMBRAGE_WIDE(GL_STENCIL_FUNC, 1),
                                UMBRAGE_WIDE(GL_STENCIL_REF, 1),
                                UMBRAGE_WIDE(GL_STENCIL_VALUE_MASK, 1),
                                UMBRAGE_WIDE(GL_STENCIL_WRITEMASK, 1),
                                UMBRAGE_WIDE(GL_STENCIL_FAIL, 1),
                                UMBRAGE_WIDE(GL_STENCIL_PASS_DEPTH_FAIL, 1),
                                UMBRAGE_WIDE(GL_STENCIL_PASS_DEPTH_PASS, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_FUNC, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_REF, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_VALUE_MASK, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_WRITEMASK, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_FAIL, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_PASS_DEPTH_FAIL, 1),
                                UMBRAGE_WIDE(GL_STENCIL_BACK_PASS_DEPTH_PASS, 1),
                                UMBRAGE_WIDE(GL_BLEND_COLOR, 4),
                                UMBRAGE_WIDE(GL_LOGIC_OP_MODE, 1),
                                UMBRAGE_WIDE(GL_CULL_FACE_MODE, 1),
                                UMBRAGE_WIDE(GL_FRONT_FACE, 1),
                                UMBRAGE_WIDE(GL_POLYGON_MODE, 2),
                                UMBRAGE_WIDE(GL_POLYGON_OFFSET_FACTOR, 1),
                                UMBRAGE_WIDE(GL_POLYGON_OFFSET_UNITS, 1),
                                UMBRAGE_WIDE(GL_LINE_WIDTH, 1),
                                UMBRAGE_WIDE(GL_POINT_SIZE, 1),
                                UMBRAGE_WIDE(GL_CLIP_ORIGIN, 1),
                                UMBRAGE_WIDE(GL_CLIP_DEPTH_MODE, 1),
                                UMBRAGE_WIDE(GL_PROVOKING_VERTEX, 1),
                                UMBRAGE_WIDE(GL_PRIMITIVE_RESTART_INDEX, 1),
                                UMBRAGE_WIDE(GL_PATCH_VERTICES, 1),
                                UMBRAGE_WIDE(GL_SAMPLE_COVERAGE_VALUE, 1),
                                UMBRAGE_WIDE(GL_SAMPLE_COVERAGE_INVERT, 1),
                                UMBRAGE_WIDE(GL_MIN_SAMPLE_SHADING_VALUE, 1),
                                UMBRAGE_WIDE(GL_CLAMP_READ_COLOR, 1),
                                UMBRAGE_WIDE(GL_PACK_SWAP_BYTES, 1),
                                UMBRAGE_WIDE(GL_PACK_LSB_FIRST, 1),
                                UMBRAGE_WIDE(GL_PACK_ROW_LENGTH, 1),
                                UMBRAGE_WIDE(GL_PACK_SKIP_ROWS, 1),
                                UMBRAGE_WIDE(GL_PACK_SKIP_PIXELS, 1),
                                UMBRAGE_WIDE(GL_PACK_ALIGNMENT, 1),
                                UMBRAGE_WIDE(GL_PACK_IMAGE_HEIGHT, 1),
                                UMBRAGE_WIDE(GL_PACK_SKIP_IMAGES, 1),
                                UMBRAGE_WIDE(GL_UNPACK_ALIGNMENT, 1),
                                UMBRAGE_WIDE(GL_UNPACK_ROW_LENGTH, 1),
                                UMBRAGE_WIDE(GL_UNPACK_SKIP_PIXELS, 1),
                                UMBRAGE_WIDE(GL_CURRENT_PROGRAM, 1),
                                UMBRAGE_WIDE(GL_PROGRAM_PIPELINE_BINDING, 1),
                                UMBRAGE_WIDE(GL_VERTEX_ARRAY_BINDING, 1),
                                UMBRAGE_WIDE(GL_ARRAY_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_ELEMENT_ARRAY_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_UNIFORM_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_SHADER_STORAGE_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_PIXEL_PACK_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_PIXEL_UNPACK_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_COPY_READ_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_COPY_WRITE_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_DRAW_INDIRECT_BUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_DRAW_FRAMEBUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_READ_FRAMEBUFFER_BINDING, 1),
                                UMBRAGE_WIDE(GL_ACTIVE_TEXTURE, 1)};

std::vector<double> floats(GLenum what, int count) {
  std::array<GLdouble, 4> v{};
  glGetDoublev(what, v.data());
  return {v.begin(), v.begin() + count};
}

void readIndexed(Snapshot& s, GLenum what, const char* name, int slots, int count) {
  for (int i = 0; i < slots; ++i) {
    std::array<GLdouble, 4> v{};
    glGetDoublei_v(what, static_cast<GLuint>(i), v.data());
    s[std::string(name) + "[" + std::to_string(i) + "]"] = {v.begin(), v.begin() + count};
  }
}

void readIntegers(Snapshot& s, GLenum what, const char* name, int slots) {
  for (int i = 0; i < slots; ++i) {
    GLint64 v = 0;
    glGetInteger64i_v(what, static_cast<GLuint>(i), &v);
    s[std::string(name) + "[" + std::to_string(i) + "]"] = {double(v)};
  }
}

void readBooleans(Snapshot& s, GLenum what, const char* name, int slots, int count) {
  for (int i = 0; i < slots; ++i) {
    std::array<GLboolean, 4> v{};
    glGetBooleani_v(what, static_cast<GLuint>(i), v.data());
    s[std::string(name) + "[" + std::to_string(i) + "]"] = {v.begin(), v.begin() + count};
  }
}

const std::vector<GLenum> kCompares{GL_NEVER,   GL_LESS,     GL_EQUAL,  GL_LEQUAL,
                                    GL_GREATER, GL_NOTEQUAL, GL_GEQUAL, GL_ALWAYS};
const std::vector<GLenum> kStencilOps{GL_KEEP,      GL_ZERO, GL_REPLACE,   GL_INCR,
                                      GL_INCR_WRAP, GL_DECR, GL_DECR_WRAP, GL_INVERT};
const std::vector<GLenum> kFactors{GL_ZERO,      GL_ONE,           GL_SRC_COLOR, GL_ONE_MINUS_SRC_ALPHA,
                                   GL_DST_ALPHA, GL_CONSTANT_COLOR};
const std::vector<GLenum> kEquations{GL_FUNC_ADD, GL_FUNC_SUBTRACT, GL_FUNC_REVERSE_SUBTRACT, GL_MIN, GL_MAX};

bool hasDepthBounds() { return epoxy_has_gl_extension("GL_EXT_depth_bounds_test"); }

GLuint makeProgram(GLenum stage, const char* source) { return glCreateShaderProgramv(stage, 1, &source); }

}  // namespace

WildHost::WildHost(bool compatibility) : compatibility_(compatibility) {
  const auto make = [](std::vector<unsigned>& names, int count, auto create) {
    names.resize(static_cast<std::size_t>(count));
    create(count, names.data());
  };
  make(buffers_, 6, glCreateBuffers);
  for (const GLuint b : buffers_) glNamedBufferStorage(b, 4096, nullptr, GL_DYNAMIC_STORAGE_BIT);
  make(textures2d_, 4, [](GLsizei n, GLuint* t) { glCreateTextures(GL_TEXTURE_2D, n, t); });
  make(textures3d_, 2, [](GLsizei n, GLuint* t) { glCreateTextures(GL_TEXTURE_3D, n, t); });
  for (const GLuint t : textures3d_) glTextureStorage3D(t, 1, GL_RGBA8, 4, 4, 4);
  make(samplers_, 3, glCreateSamplers);
  make(vertexArrays_, 3, glCreateVertexArrays);
  for (std::size_t i = 0; i < vertexArrays_.size(); ++i) glVertexArrayElementBuffer(vertexArrays_[i], buffers_[i]);
  make(framebuffers_, 2, glCreateFramebuffers);
  const std::array<GLenum, 4> formats{GL_RGBA8, GL_RGBA16F, GL_DEPTH24_STENCIL8, GL_DEPTH32F_STENCIL8};
  for (std::size_t i = 0; i < formats.size(); ++i) glTextureStorage2D(textures2d_[i], 1, formats[i], kSize, kSize);
  for (std::size_t i = 0; i < framebuffers_.size(); ++i) {
    glNamedFramebufferTexture(framebuffers_[i], GL_COLOR_ATTACHMENT0, textures2d_[i], 0);
    glNamedFramebufferTexture(framebuffers_[i], GL_DEPTH_STENCIL_ATTACHMENT, textures2d_[2 + i], 0);
  }
  for (int i = 0; i < 2; ++i)
    programs_.push_back(makeProgram(GL_VERTEX_SHADER, "#version 450 core\nvoid main() { gl_Position = vec4(0); }"));
  make(pipelines_, 2, glCreateProgramPipelines);
  for (std::size_t i = 0; i < pipelines_.size(); ++i)
    glUseProgramStages(pipelines_[i], GL_VERTEX_SHADER_BIT, programs_[i]);
  // Samplers that would spoil a fetch if they stayed.
  for (const GLuint s : samplers_) glSamplerParameteri(s, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
}

void WildHost::randomise(std::uint32_t seed) {
  random_.seed(seed);
  randomiseSwitches();
  randomiseTests();
  randomiseRaster();
  randomiseBindings();
}

void WildHost::randomiseSwitches() {
  const auto turn = [&](GLenum what) { coin() ? glEnable(what) : glDisable(what); };
  for (const Named& s : kSwitches) turn(s.what);
  if (compatibility_)
    for (const Named& s : kCompatibilitySwitches) turn(s.what);
  for (GLuint i = 0; i < kDrawBuffers; ++i) coin() ? glEnablei(GL_BLEND, i) : glDisablei(GL_BLEND, i);
  for (GLuint i = 0; i < kViewports; ++i) coin() ? glEnablei(GL_SCISSOR_TEST, i) : glDisablei(GL_SCISSOR_TEST, i);
}

void WildHost::randomiseTests() {
  glDepthFunc(pick(kCompares));
  glDepthMask(coin() ? GL_TRUE : GL_FALSE);
  glClearDepth(number(0, 10) / 10.0);
  glClearStencil(number(0, 255));
  glClearColor(0.1f * float(number(0, 10)), 0.5f, 0.25f, 1.0f);
  for (const GLenum face : {GL_FRONT, GL_BACK}) {
    glStencilFuncSeparate(face, pick(kCompares), number(0, 255), static_cast<GLuint>(number(0, 255)));
    glStencilMaskSeparate(face, static_cast<GLuint>(number(0, 255)));
    glStencilOpSeparate(face, pick(kStencilOps), pick(kStencilOps), pick(kStencilOps));
  }
  for (GLuint i = 0; i < kDrawBuffers; ++i) {
    glBlendFuncSeparatei(i, pick(kFactors), pick(kFactors), pick(kFactors), pick(kFactors));
    glBlendEquationSeparatei(i, pick(kEquations), pick(kEquations));
    glColorMaski(i, coin(), coin(), coin(), coin());
  }
  glBlendColor(0.1f, 0.2f, 0.1f * float(number(0, 10)), 0.4f);
  if (hasDepthBounds()) {
    coin() ? glEnable(GL_DEPTH_BOUNDS_TEST_EXT) : glDisable(GL_DEPTH_BOUNDS_TEST_EXT);
    glDepthBoundsEXT(number(0, 5) / 10.0, number(5, 10) / 10.0);
  }
  glLogicOp(coin() ? GL_XOR : GL_CLEAR);
  if (compatibility_) glAlphaFunc(GL_NEVER, 0.5f);
}

void WildHost::randomiseRaster() {
  glCullFace(pick({GL_FRONT, GL_BACK, GL_FRONT_AND_BACK}));
  glFrontFace(pick({GL_CW, GL_CCW}));
  if (compatibility_) {
    glPolygonMode(GL_FRONT, pick({GL_POINT, GL_LINE, GL_FILL}));
    glPolygonMode(GL_BACK, pick({GL_POINT, GL_LINE, GL_FILL}));
  } else {
    glPolygonMode(GL_FRONT_AND_BACK, pick({GL_POINT, GL_LINE, GL_FILL}));
  }
  glPolygonOffset(float(number(-5, 5)), float(number(-5, 5)));
  glLineWidth(1.0f);
  glPointSize(float(number(1, 5)));
  glClipControl(pick({GL_LOWER_LEFT, GL_UPPER_LEFT}), pick({GL_NEGATIVE_ONE_TO_ONE, GL_ZERO_TO_ONE}));
  glProvokingVertex(pick({GL_FIRST_VERTEX_CONVENTION, GL_LAST_VERTEX_CONVENTION}));
  glPrimitiveRestartIndex(static_cast<GLuint>(number(0, 9)));
  glPatchParameteri(GL_PATCH_VERTICES, number(1, 8));
  glSampleCoverage(0.1f * float(number(0, 10)), coin());
  glMinSampleShading(0.1f * float(number(0, 10)));
  glClampColor(GL_CLAMP_READ_COLOR, pick({GL_TRUE, GL_FALSE, GL_FIXED_ONLY}));
  for (GLuint i = 0; i < kViewports; ++i) {
    glViewportIndexedf(i, float(number(0, 9)), float(number(0, 9)), float(number(1, 60)), float(number(1, 60)));
    glScissorIndexed(i, number(0, 9), number(0, 9), number(0, 40), number(0, 40));
    glDepthRangeIndexed(i, number(0, 10) / 10.0, number(0, 10) / 10.0);
  }
  glPixelStorei(GL_PACK_SWAP_BYTES, coin());
  glPixelStorei(GL_PACK_LSB_FIRST, coin());
  glPixelStorei(GL_PACK_ROW_LENGTH, number(0, 99));
  glPixelStorei(GL_PACK_SKIP_ROWS, number(0, 9));
  glPixelStorei(GL_PACK_SKIP_PIXELS, number(0, 9));
  glPixelStorei(GL_PACK_IMAGE_HEIGHT, number(0, 9));
  glPixelStorei(GL_PACK_SKIP_IMAGES, number(0, 9));
  glPixelStorei(GL_PACK_ALIGNMENT, 1 << number(0, 3));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1 << number(0, 3));
  glPixelStorei(GL_UNPACK_ROW_LENGTH, number(0, 99));
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, number(0, 9));
}

void WildHost::randomiseBindings() {
  for (const GLenum target : {GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER})
    for (GLuint i = 0; i < kSlots; ++i) switch (number(0, 2)) {
        case 0: glBindBufferBase(target, i, 0); break;
        case 1: glBindBufferBase(target, i, pick(buffers_)); break;
        default: glBindBufferRange(target, i, pick(buffers_), 256 * number(0, 4), 16 * number(1, 64)); break;
      }
  for (const GLenum target :
       {GL_ARRAY_BUFFER, GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER, GL_PIXEL_PACK_BUFFER, GL_PIXEL_UNPACK_BUFFER,
        GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, GL_DRAW_INDIRECT_BUFFER})
    glBindBuffer(target, coin() ? pick(buffers_) : 0);
  for (GLuint i = 0; i < kUnits; ++i) {
    glBindTextureUnit(i, 0);
    glActiveTexture(GL_TEXTURE0 + i);
    if (coin()) glBindTexture(GL_TEXTURE_2D, pick(textures2d_));
    if (coin()) glBindTexture(GL_TEXTURE_3D, pick(textures3d_));
    glBindSampler(i, coin() ? pick(samplers_) : 0);
  }
  glActiveTexture(GL_TEXTURE0 + static_cast<GLuint>(number(0, kUnits - 1)));
  glBindVertexArray(pick(vertexArrays_));
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, pick(framebuffers_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, pick(framebuffers_));
  glUseProgram(coin() ? pick(programs_) : 0);
  glBindProgramPipeline(coin() ? pick(pipelines_) : 0);
}

Snapshot WildHost::snapshot() const {
  Snapshot s;
  for (const Named& n : kSwitches) s[n.name] = {double(glIsEnabled(n.what))};
  if (compatibility_)
    for (const Named& n : kCompatibilitySwitches) s[n.name] = {double(glIsEnabled(n.what))};
  for (GLuint i = 0; i < kDrawBuffers; ++i)
    s["GL_BLEND[" + std::to_string(i) + "]"] = {double(glIsEnabledi(GL_BLEND, i))};
  for (GLuint i = 0; i < kViewports; ++i)
    s["GL_SCISSOR_TEST[" + std::to_string(i) + "]"] = {double(glIsEnabledi(GL_SCISSOR_TEST, i))};
  for (const Wide& w : kValues) s[w.name] = floats(w.what, w.count);
  if (hasDepthBounds()) {
    s["GL_DEPTH_BOUNDS_TEST_EXT"] = {double(glIsEnabled(GL_DEPTH_BOUNDS_TEST_EXT))};
    s["GL_DEPTH_BOUNDS_EXT"] = floats(GL_DEPTH_BOUNDS_EXT, 2);
  }
  if (!compatibility_) s["GL_POLYGON_MODE"].resize(1);  // one mode for both faces
  readIndexed(s, GL_VIEWPORT, "GL_VIEWPORT", kViewports, 4);
  readIndexed(s, GL_SCISSOR_BOX, "GL_SCISSOR_BOX", kViewports, 4);
  readIndexed(s, GL_DEPTH_RANGE, "GL_DEPTH_RANGE", kViewports, 2);
  readBooleans(s, GL_COLOR_WRITEMASK, "GL_COLOR_WRITEMASK", kDrawBuffers, 4);
  for (const Named& n : {UMBRAGE_NAMED(GL_BLEND_SRC_RGB), UMBRAGE_NAMED(GL_BLEND_DST_RGB),
                         UMBRAGE_NAMED(GL_BLEND_SRC_ALPHA), UMBRAGE_NAMED(GL_BLEND_DST_ALPHA),
                         UMBRAGE_NAMED(GL_BLEND_EQUATION_RGB), UMBRAGE_NAMED(GL_BLEND_EQUATION_ALPHA)})
    readIntegers(s, n.what, n.name, kDrawBuffers);
  for (const Named& n : {UMBRAGE_NAMED(GL_UNIFORM_BUFFER_BINDING), UMBRAGE_NAMED(GL_UNIFORM_BUFFER_START),
                         UMBRAGE_NAMED(GL_UNIFORM_BUFFER_SIZE), UMBRAGE_NAMED(GL_SHADER_STORAGE_BUFFER_BINDING),
                         UMBRAGE_NAMED(GL_SHADER_STORAGE_BUFFER_START), UMBRAGE_NAMED(GL_SHADER_STORAGE_BUFFER_SIZE)})
    readIntegers(s, n.what, n.name, kSlots);
  for (const Named& n :
       {UMBRAGE_NAMED(GL_TEXTURE_BINDING_2D), UMBRAGE_NAMED(GL_TEXTURE_BINDING_3D), UMBRAGE_NAMED(GL_SAMPLER_BINDING)})
    readIntegers(s, n.what, n.name, kUnits);
  return s;
}

std::string difference(const Snapshot& before, const Snapshot& after) {
  std::ostringstream out;
  for (const auto& [name, value] : before) {
    const auto& now = after.at(name);
    if (now == value) continue;
    out << name << ":";
    for (const double v : value) out << " " << v;
    out << " ->";
    for (const double v : now) out << " " << v;
    out << "\n";
  }
  return out.str();
}

}  // namespace umbrage::state
