#include "umbrage/techniques/gl/planar.hpp"

#include <umbrage_shaders/planar_bit_frag.hpp>
#include <umbrage_shaders/planar_shadow_frag.hpp>
#include <umbrage_shaders/planar_shadow_vert.hpp>

#include <algorithm>
#include <array>
#include <optional>

#include "umbrage/math/predicates.hpp"
#include "umbrage/render/mask_technique.hpp"

namespace umbrage::techniques {
namespace {

// The stencil holds the number of the plane that a pixel shows, and whether it lies in shadow.
constexpr std::uint8_t kPlaneBits = 0x7f, kShadowBit = 0x80;
static_assert(shadow::kMostPlanes <= kPlaneBits);

constexpr std::size_t kChunk = 256;  ///< casters that are left out together

// As planar_shadow.vert has it.
struct PlaneBlock {
  Vec4f plane, light;
  float lightHeight;
  std::array<float, 3> unused{};
};

struct BitBlock {
  std::uint32_t bit;
  std::array<std::uint32_t, 3> unused{};
};

/// Casters that follow each other in the order in which they are drawn.
struct Chunk {
  std::size_t begin, end;
  Box3 box;
};

/// Casters in the order of their planes, so that all but those of one plane are two pieces.
struct OrderedCasters {
  std::vector<mesh::Triangle> triangles;
  std::vector<Chunk> chunks;  ///< each of one plane's casters, or of those in none
  std::vector<std::uint8_t> planeOfChunk;
};

// `order`: triangles of the surfaces.
OrderedCasters chunked(const scene::Surfaces& surfaces, const shadow::ScenePlanes& planes,
                       const std::vector<std::uint32_t>& order) {
  OrderedCasters out;
  for (const std::uint32_t t : order) {
    const std::size_t at = out.triangles.size();
    if (out.chunks.empty() || out.planeOfChunk.back() != planes.planeOf[t] || at - out.chunks.back().begin == kChunk) {
      out.chunks.push_back({at, at, {}});
      out.planeOfChunk.push_back(planes.planeOf[t]);
    }
    out.triangles.push_back(surfaces.triangles[t]);
    out.chunks.back().end = at + 1;
    for (int k = 0; k < 3; ++k) out.chunks.back().box.add(surfaces.corner(t, k));
  }
  return out;
}

std::vector<std::uint32_t> castersByPlane(const scene::Surfaces& surfaces, const shadow::ScenePlanes& planes) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    if (surfaces.casts[t] != 0) order.push_back(t);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t t) { return planes.planeOf[t]; });
  return order;
}

// Lowest and highest of a linear function over a box.
struct Span {
  double low, high;
};
Span spanOver(const Box3& box, const Vec4& plane) {
  const double middle = glm::dot(Vec3(plane), box.centre()) + plane.w;
  const double half = 0.5 * glm::dot(glm::abs(Vec3(plane)), box.size());
  return {middle - half, middle + half};
}

// Whether anything of the box may lie above the plane and before the light, `lightHeight` above it: surely when it does.
bool mayShade(const Box3& box, const Vec4& plane, const Vec4& light, double lightHeight) {
  const Span height = spanOver(box, plane);
  const double rounding = 1e-9 * (std::abs(height.low) + std::abs(height.high) + std::abs(plane.w));
  return height.high > -rounding && (light.w == 0.0 || height.low * light.w < lightHeight + rounding * light.w);
}

class Planar final : public render::MaskPainter {
 public:
  explicit Planar(shadow::PlaneSearch search) : search_(std::move(search)) {}

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    planes_ = shadow::findPlanes(geometry->surfaces, search_);
    order_ = castersByPlane(geometry->surfaces, planes_);
    all_ = chunked(geometry->surfaces, planes_, order_);
    unshadowed_.clear();
    std::vector<std::uint32_t> packed((planes_.planeOf.size() + 3) / 4);
    for (std::size_t t = 0; t < planes_.planeOf.size(); ++t) {
      packed[t / 4] |= std::uint32_t{planes_.planeOf[t]} << (t % 4 * 8);
      unshadowed_.push_back(planes_.planeOf[t] == 0 ? 1 : 0);
    }
    if (auto done = render::setStorage(planeOf_, std::as_bytes(std::span(packed)), "triangles"); !done) return done;
    return indices_.setAll(all_.triangles);
  }

  // The number of every pixel's plane, bit by bit.
  Result<void> begin(const render::SeenFrame& frame) override {
    if (!bitProgram_) bitProgram_.emplace(render::screenVertexSource(), shaders::kPlanarBitFrag);
    const gl::Framebuffer& target = frame.input.frame->stencilTarget();
    {
      gl::Pass pass(frame.scope, target, frame.placement);
      pass.clearStencil(0);
    }
    for (std::uint32_t bit = 0; planes_.planes.size() >> bit != 0; ++bit) {
      if (auto done = uniforms_.setOne(BitBlock{bit}); !done) return done;
      gl::PassState state = frame.placement;
      const gl::StencilFace set{.pass = gl::StencilOp::replace};
      state.stencil = {.test = true,
                       .reference = kPlaneBits,
                       .writeMask = static_cast<std::uint8_t>(1u << bit),
                       .front = set,
                       .back = set};
      gl::Pass pass(frame.scope, target, state);
      pass.use(*bitProgram_);
      pass.uniforms(1, uniforms_);
      pass.storage(1, planeOf_);
      pass.texture(0, frame.input.frame->ids());
      pass.draw(vertices_, 3);
    }
    return {};
  }

  Result<void> paint(const render::SeenFrame& frame, const render::MaskLight& light,
                     shadow::LightStats& stats) override {
    stats.method = "planar";
    clearShadow(frame);
    if (auto done = chooseCasters(frame.geometry.surfaces, light.light); !done) return done;
    for (std::size_t p = 0; p < planes_.planes.size() && !light.area.empty(); ++p)
      if (auto done = project(frame, light, p, stats); !done) return done;
    stats.reason = "casters projected onto " + std::to_string(stats.planes) + " of " +
                   std::to_string(planes_.planes.size()) + " planes; other surfaces have no shadows";
    render::run(frame.scope, render::planMask(frame.placement, static_cast<int>(light.slot), light.area, kShadowBit),
                frame.input);
    return {};
  }

  [[nodiscard]] std::span<const std::uint8_t> unshadowed() const override { return unshadowed_; }

 private:
  static void clearShadow(const render::SeenFrame& frame) {
    gl::PassState state = frame.placement;
    state.stencil.writeMask = kShadowBit;
    gl::Pass pass(frame.scope, frame.input.frame->stencilTarget(), state);
    pass.clearStencil(0);
  }

  // A triangle in whose plane the light lies casts no shadow. Rounding would give it one, even a large one where the light is one of its corners.
  Result<void> chooseCasters(const scene::Surfaces& surfaces, const scene::Light& light) {
    const Vec4 lamp = scene::homogeneous(light, surfaces.origin);
    std::vector<std::uint32_t> some;
    for (const std::uint32_t t : order_)
      if (lightSide(surfaces.corner(t, 0), surfaces.corner(t, 1), surfaces.corner(t, 2), lamp) != 0) some.push_back(t);
    isAll_ = some.size() == order_.size();
    if (isAll_) return {};
    some_ = chunked(surfaces, planes_, some);
    return someIndices_.setAll(some_.triangles);
  }

  // The shadows on one plane, where the light reaches it.
  Result<void> project(const render::SeenFrame& frame, const render::MaskLight& light, std::size_t which,
                       shadow::LightStats& stats) {
    const Vec3& origin = frame.geometry.surfaces.origin;
    const shadow::ScenePlane& plane = planes_.planes[which];
    const gl::Rect area = gl::intersect(light.area, render::boxArea(frame.view, plane.bounds, origin, frame.placement));
    if (area.empty()) return {};
    Vec4 lamp = scene::homogeneous(light.light, origin);
    const double lightSide = glm::dot(plane.equation, lamp);
    if (lightSide == 0.0) return {};  // it shines along the plane, which faces it nowhere
    const Vec4 equation = lightSide < 0.0 ? -plane.equation : plane.equation;
    const auto ranges = castersFor(which, equation, lamp, std::abs(lightSide));
    if (ranges.empty()) return {};
    const Vec3 eye = frame.view.eye - origin;
    lamp = Vec4(Vec3(lamp) - eye * lamp.w, lamp.w);
    const double size = std::max(glm::length(Vec3(lamp)), lamp.w);
    const Vec4 fromEye(Vec3(equation), glm::dot(Vec3(equation), eye) + equation.w);
    if (auto done = uniforms_.setOne(
            PlaneBlock{Vec4f(fromEye), Vec4f(lamp / size), static_cast<float>(std::abs(lightSide) / size)});
        !done)
      return done;
    draw(frame, light, which, area, ranges);
    ++stats.planes;
    return {};
  }

  // What may cast a shadow onto a plane: pieces of the indices. What lies in the plane does not.
  [[nodiscard]] std::vector<render::IndexRange> castersFor(std::size_t which, const Vec4& plane, const Vec4& light,
                                                           double lightHeight) const {
    std::vector<render::IndexRange> ranges;
    const OrderedCasters& casters = isAll_ ? all_ : some_;
    for (std::size_t c = 0; c < casters.chunks.size(); ++c) {
      const Chunk& chunk = casters.chunks[c];
      if (casters.planeOfChunk[c] == which + 1 || !mayShade(chunk.box, plane, light, lightHeight)) continue;
      const std::size_t first = 3 * chunk.begin, count = 3 * (chunk.end - chunk.begin);
      if (!ranges.empty() && ranges.back().first + ranges.back().count == first)
        ranges.back().count += count;
      else
        ranges.push_back({first, count});
    }
    return ranges;
  }

  void draw(const render::SeenFrame& frame, const render::MaskLight& light, std::size_t which, const gl::Rect& area,
            const std::vector<render::IndexRange>& ranges) {
    if (!shadowProgram_) shadowProgram_.emplace(shaders::kPlanarShadowVert, shaders::kPlanarShadowFrag);
    gl::PassState state = frame.placement;
    state.clipDistances = 2;
    state.scissor = area;
    const gl::StencilFace mark{.pass = gl::StencilOp::replace};
    state.stencil = {.test = true,
                     .compare = gl::Compare::equal,
                     .reference = static_cast<std::uint8_t>(kShadowBit | (which + 1)),
                     .readMask = kPlaneBits,
                     .writeMask = kShadowBit,
                     .front = mark,
                     .back = mark};
    gl::Pass pass(frame.scope, frame.input.frame->stencilTarget(), state);
    pass.use(*shadowProgram_);
    pass.uniforms(0, frame.input.lights[light.slot].view);
    pass.uniforms(1, uniforms_);
    pass.storage(0, frame.input.positions);
    for (const render::IndexRange& range : ranges)
      pass.drawIndexed(isAll_ ? vertices_ : someVertices_, range.first, range.count);
  }

  shadow::PlaneSearch search_;
  shadow::ScenePlanes planes_;
  std::vector<std::uint32_t> order_;  ///< all casters
  OrderedCasters all_, some_;         ///< and those that may cast shadows in one light
  bool isAll_ = true;                 ///< they are the same
  std::vector<std::uint8_t> unshadowed_;
  gl::Buffer planeOf_, indices_, someIndices_, uniforms_;
  gl::VertexArray vertices_{indices_}, someVertices_{someIndices_};
  std::optional<gl::Program> bitProgram_, shadowProgram_;
};

}  // namespace

shadow::Traits planarTraits() {
  return {
      .name = "planar",
      .summary = "Casters projected onto the largest planes of the scene; exact there, no shadows on other surfaces",
      .soft = true,
      .needsGraphics = true,
      .edgeTolerancePx = 1};
}

std::unique_ptr<render::GlTechnique> makePlanar(std::shared_ptr<gl::Context> context,
                                                const shadow::PlaneSearch& planes) {
  return render::makeMaskTechnique(
      planarTraits(), [planes] { return std::make_unique<Planar>(planes); }, std::move(context));
}

}  // namespace umbrage::techniques
