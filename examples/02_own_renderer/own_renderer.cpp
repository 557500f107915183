// Exact shadows inside your own renderer.
//
// This program has its own OpenGL context, its own framebuffer with an ordinary 24-bit depth buffer, its own shaders and draw
// calls. What Umbrage adds is marked "1", "2", "3" in draw(): tell it what casts, and before each light let it mark the
// shadows in the stencil. It links umbrage::render and OpenGL, nothing else. It checks its own picture, and that its OpenGL
// state was left alone.

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <vector>

#include "umbrage/render/stencil_shadows.hpp"

using umbrage::Box3, umbrage::Mat4, umbrage::Vec3, umbrage::Vec3f;

namespace {

constexpr int kWidth = 960, kHeight = 540;
constexpr int kNoGraphics = 77;

[[noreturn]] void stop(const std::string& why, int code = 1) {
  std::fprintf(stderr, "%s\n", why.c_str());
  std::exit(code);
}

// ---- the host's context ----

void openContext() {
  if (!epoxy_has_egl()) stop("no EGL here", kNoGraphics);
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const bool surfaceless = extensions != nullptr && std::strstr(extensions, "EGL_MESA_platform_surfaceless") != nullptr;
  const EGLDisplay display = surfaceless ? eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr)
                                         : eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE)
    stop("no display here", kNoGraphics);
  eglBindAPI(EGL_OPENGL_API);
  const std::array<EGLint, 5> wanted{EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_NONE};
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
  if (context == EGL_NO_CONTEXT || eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE)
    stop("no OpenGL 4.5 here", kNoGraphics);
}

// ---- the host's scene: a courtyard of boxes on a plane ----

struct Vertex {
  Vec3f position, normal, colour;
};

struct World {
  std::vector<Box3> boxes;
  std::vector<Vertex> vertices;  // triangle after triangle, as many an engine keeps them
  std::size_t groundVertices = 0;
};

void addQuad(World& world, const std::array<Vec3, 4>& q, const Vec3& normal, const Vec3& colour) {
  for (const int i : {0, 1, 2, 0, 2, 3}) world.vertices.push_back({Vec3f(q[i]), Vec3f(normal), Vec3f(colour)});
}

void addBox(World& world, const Vec3& low, const Vec3& high, const Vec3& colour) {
  Box3 box;
  box.add(low);
  box.add(high);
  world.boxes.push_back(box);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0.0, 1.0}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      std::array<Vec3, 4> q;
      for (int i = 0; i < 4; ++i) {
        q[i][axis] = side == 0.0 ? low[axis] : high[axis];
        q[i][u] = i == 1 || i == 2 ? high[u] : low[u];
        q[i][v] = i >= 2 ? high[v] : low[v];
      }
      Vec3 normal(0.0);
      normal[axis] = 2.0 * side - 1.0;
      addQuad(world, q, normal, colour);
    }
}

World makeWorld() {
  World world;
  addQuad(world, {Vec3(-60, -60, 0), Vec3(60, -60, 0), Vec3(60, 60, 0), Vec3(-60, 60, 0)}, {0, 0, 1},
          {0.62, 0.62, 0.58});
  world.groundVertices = world.vertices.size();
  const Vec3 stone(0.78, 0.7, 0.58), brick(0.68, 0.38, 0.28), slate(0.42, 0.48, 0.55);
  addBox(world, {-9, 4, 0}, {-2, 7, 5}, brick);
  addBox(world, {3, 3, 0}, {6, 8, 8}, slate);
  for (const double x : {-3.0, -0.4, 2.2}) addBox(world, {x, -1.2, 0}, {x + 0.6, -0.6, 3}, stone);
  addBox(world, {-3.4, -1.4, 3}, {3.2, -0.4, 3.6}, stone);  // a lintel over the three posts
  addBox(world, {5, -5, 1.5}, {7, -3, 3.5}, brick);         // floats
  return world;
}

// What casts, for Umbrage: positions and triangles, in any order and topology. The ground only receives.
umbrage::shadow::CasterSet castersOf(const World& world) {
  std::vector<Vec3f> positions;
  std::vector<umbrage::mesh::Triangle> triangles;
  for (std::size_t i = world.groundVertices; i < world.vertices.size(); ++i) {
    positions.push_back(world.vertices[i].position);
    if (i % 3 == 2) {
      const auto last = static_cast<std::uint32_t>(positions.size());
      triangles.push_back({last - 3, last - 2, last - 1});
    }
  }
  return umbrage::shadow::buildCasters(positions, triangles);
}

// ---- the host's renderer ----

constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 0) uniform mat4 transform;
layout(location = 0) out vec3 at;
layout(location = 1) out vec3 n;
layout(location = 2) out vec3 c;
invariant gl_Position;
void main() { at = position; n = normal; c = colour; gl_Position = transform * vec4(position, 1.0); })";

constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 0) in vec3 at;
layout(location = 1) in vec3 n;
layout(location = 2) in vec3 c;
layout(location = 1) uniform vec4 light;    // w = 0: direction towards it; w < 0: no light, ambient only
layout(location = 2) uniform vec3 radiance;
layout(location = 0) out vec4 result;
void main() {
  float cosine = light.w < 0.0 ? 1.0 : max(0.0, dot(n, normalize(light.xyz - light.w * at)));
  result = vec4(c * radiance * cosine, 1.0);
})";

GLuint makeProgram() {
  const GLuint program = glCreateProgram();
  for (const auto& [stage, source] :
       {std::pair(GL_VERTEX_SHADER, kVertexShader), {GL_FRAGMENT_SHADER, kFragmentShader}}) {
    const GLuint shader = glCreateShader(stage);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
  }
  glLinkProgram(program);
  GLint good = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good != GL_TRUE) stop("the host's shaders do not link");
  return program;
}

struct Host {
  World world = makeWorld();
  Vec3 eye{-11, -15, 8};
  Mat4 view = glm::lookAt(eye, Vec3(0, 1, 1), Vec3(0, 0, 1));
  Mat4 projection = glm::perspective(0.75, double(kWidth) / kHeight, 0.5, 300.0);  // ordinary depth, [-1, 1]
  GLuint program = makeProgram();
  GLuint vertexArray = 0, framebuffer = 0;
};

Host makeHost() {
  Host host;
  GLuint buffer = 0;
  std::array<GLuint, 2> pictures{};
  glCreateBuffers(1, &buffer);
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(host.world.vertices.size() * sizeof(Vertex)),
                       host.world.vertices.data(), 0);
  glCreateVertexArrays(1, &host.vertexArray);
  glVertexArrayVertexBuffer(host.vertexArray, 0, buffer, 0, sizeof(Vertex));
  for (GLuint i = 0; i < 3; ++i) {
    glEnableVertexArrayAttrib(host.vertexArray, i);
    glVertexArrayAttribFormat(host.vertexArray, i, 3, GL_FLOAT, GL_FALSE, i * sizeof(Vec3f));
    glVertexArrayAttribBinding(host.vertexArray, i, 0);
  }
  glCreateTextures(GL_TEXTURE_2D, 2, pictures.data());
  glTextureStorage2D(pictures[0], 1, GL_SRGB8_ALPHA8, kWidth, kHeight);
  glTextureStorage2D(pictures[1], 1, GL_DEPTH24_STENCIL8, kWidth, kHeight);
  glCreateFramebuffers(1, &host.framebuffer);
  glNamedFramebufferTexture(host.framebuffer, GL_COLOR_ATTACHMENT0, pictures[0], 0);
  glNamedFramebufferTexture(host.framebuffer, GL_DEPTH_STENCIL_ATTACHMENT, pictures[1], 0);
  return host;
}

struct Lamp {
  umbrage::scene::Light light;
  std::vector<std::uint8_t> stencil;  // what Umbrage marked, kept for the check
};

void drawWorld(const Host& host, const glm::vec4& light, const Vec3& radiance) {
  const glm::mat4 transform(host.projection * host.view);
  glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(transform));
  glUniform4fv(1, 1, glm::value_ptr(light));
  glUniform3fv(2, 1, glm::value_ptr(Vec3f(radiance)));
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(host.world.vertices.size()));
}

// Some of what a renderer would be sorry to find changed.
std::vector<GLint> stateOf() {
  std::vector<GLint> state;
  for (const GLenum what : {GL_CURRENT_PROGRAM,
                            GL_VERTEX_ARRAY_BINDING,
                            GL_DRAW_FRAMEBUFFER_BINDING,
                            GL_READ_FRAMEBUFFER_BINDING,
                            GL_DEPTH_FUNC,
                            GL_STENCIL_FUNC,
                            GL_STENCIL_PASS_DEPTH_FAIL,
                            GL_STENCIL_BACK_PASS_DEPTH_FAIL,
                            GL_BLEND_SRC_RGB,
                            GL_BLEND_DST_RGB,
                            GL_CLIP_ORIGIN,
                            GL_CLIP_DEPTH_MODE,
                            GL_FRONT_FACE,
                            GL_CULL_FACE_MODE,
                            GL_DEPTH_WRITEMASK,
                            GL_STENCIL_WRITEMASK,
                            GL_SHADER_STORAGE_BUFFER_BINDING,
                            GL_UNIFORM_BUFFER_BINDING,
                            GL_ACTIVE_TEXTURE,
                            GL_PACK_ALIGNMENT}) {
    GLint value = 0;
    glGetIntegerv(what, &value);
    state.push_back(value);
  }
  for (const GLenum what : {GL_DEPTH_TEST, GL_STENCIL_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_DEPTH_CLAMP,
                            GL_FRAMEBUFFER_SRGB, GL_DITHER})
    state.push_back(glIsEnabled(what));
  std::array<GLint, 4> viewport{}, mask{};
  glGetIntegerv(GL_VIEWPORT, viewport.data());
  glGetIntegerv(GL_COLOR_WRITEMASK, mask.data());
  state.insert(state.end(), viewport.begin(), viewport.end());
  state.insert(state.end(), mask.begin(), mask.end());
  return state;
}

void draw(const Host& host, std::vector<Lamp>& lamps) {
  // 1. Once: what casts.
  auto shadows = umbrage::render::StencilShadows::make(castersOf(host.world));
  if (!shadows) stop(shadows.error().text());

  // The host's own depth and ambient light.
  glBindFramebuffer(GL_FRAMEBUFFER, host.framebuffer);
  glViewport(0, 0, kWidth, kHeight);
  glUseProgram(host.program);
  glBindVertexArray(host.vertexArray);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glClearColor(0.55f, 0.68f, 0.82f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
  drawWorld(host, glm::vec4(0, 0, 0, -1), Vec3(0.16, 0.18, 0.22));

  // The host's own light passes, added where the stencil is 0.
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_EQUAL, 0, 0xff);
  for (Lamp& lamp : lamps) {
    // 2. Before each light: mark its shadows in the stencil.
    const auto before = stateOf();
    const auto marked = shadows->mark(lamp.light, {.view = host.view, .projection = host.projection});
    if (!marked) stop(marked.error().text());
    if (stateOf() != before) stop("the host's OpenGL state was changed");
    std::printf("%s: %s, %s; %zu silhouette edges\n", lamp.light.name.c_str(), marked->method.c_str(),
                marked->reason.c_str(), marked->silhouetteEdges);

    // 3. Then light what is left.
    drawWorld(host, glm::vec4(umbrage::scene::homogeneous(lamp.light, Vec3(0.0))),
              lamp.light.colour * lamp.light.intensity);

    lamp.stencil.resize(std::size_t(kWidth) * kHeight);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, kWidth, kHeight, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, lamp.stencil.data());
  }
}

// ---- the check: the ground's shadows by arithmetic ----

bool hitsBox(const Box3& box, const Vec3& from, const Vec3& along, double longest) {
  double enter = 0.0, leave = longest;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.min[k] - from[k]) / along[k], b = (box.max[k] - from[k]) / along[k];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

enum class Truth { notGround, lit, shadowed };

Truth truthAt(const Host& host, const umbrage::scene::Light& light, double x, double y) {
  const Mat4 back = glm::inverse(host.projection * host.view);
  const glm::dvec4 far = back * glm::dvec4(2.0 * x / kWidth - 1.0, 2.0 * y / kHeight - 1.0, 1.0, 1.0);
  const Vec3 ray = Vec3(far) / far.w - host.eye;
  const double t = -host.eye.z / ray.z;
  const Vec3 p = host.eye + t * ray;
  if (!(t > 0.0) || std::max(std::abs(p.x), std::abs(p.y)) > 60.0) return Truth::notGround;
  for (const Box3& box : host.world.boxes)
    if (hitsBox(box, host.eye, ray, t)) return Truth::notGround;
  const umbrage::Vec4 lamp = umbrage::scene::homogeneous(light, Vec3(0.0));
  for (const Box3& box : host.world.boxes)
    if (hitsBox(box, p, umbrage::scene::towardsLight(lamp, p), lamp.w == 0.0 ? 1e9 : 1.0)) return Truth::shadowed;
  return Truth::lit;
}

// Pixels whose whole neighbourhood is of one kind must have been marked so.
void check(const Host& host, const Lamp& lamp) {
  std::size_t checked = 0, shadowed = 0, wrong = 0;
  for (int y = 1; y < kHeight - 1; ++y)
    for (int x = 1; x < kWidth - 1; ++x) {
      const Truth truth = truthAt(host, lamp.light, x + 0.5, y + 0.5);
      bool clear = truth != Truth::notGround;
      for (const double dx : {-0.5, 1.5})
        for (const double dy : {-0.5, 1.5}) clear = clear && truthAt(host, lamp.light, x + dx, y + dy) == truth;
      if (!clear) continue;
      const bool marked = lamp.stencil[std::size_t(y) * kWidth + std::size_t(x)] != 0;
      ++checked;
      shadowed += truth == Truth::shadowed;
      wrong += marked != (truth == Truth::shadowed);
    }
  std::printf("%s: %zu pixels of the ground checked, %zu of them in shadow, %zu wrong\n", lamp.light.name.c_str(),
              checked, shadowed, wrong);
  if (wrong > 0 || shadowed == 0) stop("the shadows are wrong");
}

void writePicture(const Host& host, const std::string& path) {
  std::vector<std::uint8_t> pixels(std::size_t(kWidth) * kHeight * 3);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, host.framebuffer);
  glReadPixels(0, 0, kWidth, kHeight, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << kWidth << " " << kHeight << "\n255\n";
  for (int y = kHeight - 1; y >= 0; --y)
    file.write(reinterpret_cast<const char*>(pixels.data()) + std::ptrdiff_t(y) * kWidth * 3, kWidth * 3);
  if (!file) stop("cannot write " + path);
  std::printf("%s\n", path.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  openContext();
  const Host host = makeHost();
  std::vector<Lamp> lamps{
      {{umbrage::scene::DirectionalLight{{0.7, 0.25, -0.6}}, Vec3(1.0, 0.92, 0.78), 0.75, "sun"}, {}},
      {{umbrage::scene::PointLight{{1.0, -4.5, 5.0}}, Vec3(0.45, 0.6, 1.0), 0.6, "lamp"}, {}}};
  draw(host, lamps);
  for (const Lamp& lamp : lamps) check(host, lamp);
  writePicture(host, argc > 1 ? argv[1] : "own_renderer.ppm");
  return glGetError() == GL_NO_ERROR ? 0 : 1;
}
