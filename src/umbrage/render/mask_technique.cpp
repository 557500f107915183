#include "umbrage/render/mask_technique.hpp"
#include "umbrage/render/detail/card_technique.hpp"

#include <umbrage_shaders/mask_add_frag.hpp>
#include <umbrage_shaders/mask_mean_frag.hpp>
#include <umbrage_shaders/screen_vert.hpp>

#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/frame_data.hpp"
#include "umbrage/render/mask_sums.hpp"
#include "umbrage/shadow/light_samples.hpp"
#include "umbrage/shadow/phase_clock.hpp"

namespace umbrage::render {
namespace {

constexpr std::size_t kPart = 16;  ///< samples after which the caller is told, or may have enough

// As mask_add.frag has it.
struct SampleBlock {
  Vec4f ball{0.0f}, point{0.0f};
};

SampleBlock sampleBlock(const shadow::LightSample& sample, const Vec3& eye, std::size_t number) {
  SampleBlock block;
  if (sample.ball) {
    block.ball = Vec4f(Vec3f(sample.ball->centre - eye), static_cast<float>(sample.ball->radius));
    block.point = Vec4f(Vec3f(std::get<scene::PointLight>(sample.light.shape).position - eye), 0.0f);
  }
  block.point.w = static_cast<float>(shadow::halfOf(number));
  return block;
}

class MaskTechnique final : public detail::CardTechnique {
 public:
  MaskTechnique(const shadow::Traits& traits, MaskPainterMaker makePainter, std::shared_ptr<gl::Context> context)
      : CardTechnique(traits, std::move(context)), makePainter_(std::move(makePainter)) {}
  ~MaskTechnique() override {
    const gl::CurrentContext current(context_);
    own_.reset();
  }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    const gl::CurrentContext current(context_);
    const gl::HostScope scope;
    auto scene = GpuScene::make(geometry->surfaces);
    if (!scene) return tl::unexpected(scene.error());
    if (own_ == nullptr) own_ = std::make_unique<Own>(makePainter_());
    own_->quirks = context_ != nullptr ? context_->quirks() : gl::findQuirks();
    own_->scene.emplace(std::move(*scene));
    if (auto done = own_->painter->prepare(geometry); !done) return done;
    geometry_ = std::move(geometry);
    const scene::Surfaces& surfaces = geometry_->surfaces;
    room_ = surfaces.bounds;
    if (!room_.empty()) room_.min += surfaces.origin, room_.max += surfaces.origin;
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(geometry_ != nullptr, "prepare() first");
    const gl::CurrentContext current(context_);
    gl::HostScope scope;
    auto& target = own_->frame;
    if (auto done = fit(target, frame.camera.width, frame.camera.height); !done) return tl::unexpected(done.error());
    shadow::Shading shading;
    shadow::PhaseClock clock(shading.stats.phases);
    const PhaseEnd ended = [&](const char* phase) { clock.end(phase); };
    if (auto done = render(scope, *target, frame, nullptr, true, shading.stats, ended); !done)
      return tl::unexpected(done.error());
    const View view = viewOf(frame.camera, geometry_->surfaces.bounds.radius());
    readMasks(scope, *target, view, frame.lights.size(), readSurface(scope, *target), shading);
    shading.unshadowed = unshadowedPixels(frame.camera, shading.surface);
    clock.end("readback");
    return shading;
  }

 private:
  Result<void> paint(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame, const PictureOptions& options,
                     shadow::FrameStats& stats, const PhaseEnd& ended) override {
    return render(scope, target, frame, &options, false, stats, ended);
  }

  // All that lives in the context.
  struct Own {
    explicit Own(std::unique_ptr<MaskPainter> made) : painter(std::move(made)) {}
    std::unique_ptr<MaskPainter> painter;
    std::optional<GpuScene> scene;
    std::optional<GpuFrame> frame;
    gl::Quirks quirks;
    Programs programs;
    FrameData data;
    std::vector<GpuLight> lights;  ///< one more than the frame has: of the points of lights with an extent
    std::optional<gl::Program> add, mean;
    gl::Buffer sample;
  };

  // What the lights of one frame have in common.
  struct Work {
    SeenFrame seen;
    GpuFrame& target;
    const shadow::Frame& frame;
    bool mayRead;  ///< sums may be read back while they grow
  };

  Result<void> render(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame, const PictureOptions* options,
                      bool mayRead, shadow::FrameStats& stats, const PhaseEnd& ended) {
    const scene::Camera& camera = frame.camera;
    const View view = viewOf(camera, geometry_->surfaces.bounds.radius());
    gl::PassState placement;
    placement.viewport = {0, 0, camera.width, camera.height};
    while (own_->lights.size() <= frame.lights.size()) own_->lights.emplace_back();
    if (own_->quirks.readsStorageLate) gl::finish();  // the frame before may wait still
    for (const auto& done : {upload(own_->data, view, geometry_->surfaces.origin, camera, options),
                             own_->scene->arrangeFor(*geometry_, view, camera.width, camera.height),
                             target.needMasks(frame.lights.size())})
      if (!done) return done;
    if (ended) ended("facing");
    const RunInput input{.programs = own_->programs,
                         .positions = own_->scene->positions(),
                         .scene = &*own_->scene,
                         .frame = &target,
                         .materials = options != nullptr ? &own_->data.materials : nullptr,
                         .view = &own_->data.view,
                         .shading = &own_->data.shading,
                         .lights = own_->lights};
    run(scope, planSurfaces(placement, view.reversed), input, ended);
    const Work work{{scope, *geometry_, view, camera, placement, input}, target, frame, mayRead};
    if (auto done = own_->painter->begin(work.seen); !done) return done;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      stats.lights.emplace_back();
      if (auto done = addLight(work, i, stats.lights.back()); !done) return done;
      if (!ended) continue;
      gl::finish();
      ended("shadows");
    }
    if (options != nullptr)
      run(scope, planMaskedPicture(placement, static_cast<int>(frame.lights.size())), input, ended);
    return {};
  }

  Result<void> paint(const Work& work, const scene::Light& light, std::size_t slot, shadow::LightStats& stats) {
    const View& view = work.seen.view;
    auto facing = upload(own_->lights[slot], geometry_->surfaces, view, work.seen.camera, light);
    if (!facing) return tl::unexpected(facing.error());
    const gl::Rect scenes = boxArea(view, geometry_->surfaces.bounds, geometry_->surfaces.origin, work.seen.placement);
    const gl::Rect area = gl::intersect(litArea(view, light, work.seen.placement), scenes);
    return own_->painter->paint(work.seen, {light, slot, *facing, area}, stats);
  }

  Result<void> addLight(const Work& work, std::size_t index, shadow::LightStats& stats) {
    const scene::Light& light = work.frame.lights[index];
    if (!scene::isArea(light) || !traits_.soft) return paint(work, light, index, stats);
    // For what the picture needs to know of the whole light.
    if (auto done = upload(own_->lights[index], geometry_->surfaces, work.seen.view, work.seen.camera, light); !done)
      return tl::unexpected(done.error());
    for (const auto& done : {work.target.needMasks(own_->lights.size()), work.target.needMaskSum()})
      if (!done) return done;
    startSum(work);
    const std::size_t most = std::max<std::size_t>(1, work.frame.soft.samples);
    std::size_t taken = 0;
    while (taken < most) {
      const auto samples = shadow::lightSamples(light, taken, std::min(kPart, most - taken), room_);
      for (const shadow::LightSample& sample : samples)
        if (auto done = addSample(work, sample, taken++, stats); !done) return done;
      if (work.mayRead && hasEnough(work, index, taken)) break;
    }
    finishSum(work, index);
    stats.reason = "the mean of " + std::to_string(taken) + " points of the light; each: " + stats.reason;
    if (work.mayRead) stats.soft = softStats(sums(work), ids(work), taken);
    return {};
  }

  [[nodiscard]] image::Image<Vec4f> sums(const Work& work) const {
    return gl::readQuadruples(work.seen.scope, work.target.maskSumTarget(), work.target.width(), work.target.height());
  }
  [[nodiscard]] image::Image<std::uint32_t> ids(const Work& work) const {
    return gl::readIds(work.seen.scope, work.target.surfaceTarget(), work.target.width(), work.target.height());
  }

  // Only where somebody wants to know, since it waits for the graphics card.
  [[nodiscard]] bool hasEnough(const Work& work, std::size_t light, std::size_t taken) const {
    const shadow::SoftSampling& soft = work.frame.soft;
    if (!soft.progress && soft.enough <= 0.0) return false;
    const double error = softStats(sums(work), ids(work), taken).error;
    if (soft.progress && !soft.progress({light, taken, error})) return true;
    return taken >= 2 * kPart && error <= soft.enough;
  }

  static void startSum(const Work& work) {
    gl::PassState state = work.seen.placement;
    state.colourWrite = true;
    gl::Pass pass(work.seen.scope, work.target.maskSumTarget(), state);
    pass.clearColour({0.0f, 0.0f, 0.0f, 0.0f});
  }

  Result<void> addSample(const Work& work, const shadow::LightSample& sample, std::size_t number,
                         shadow::LightStats& stats) {
    const std::size_t slot = own_->lights.size() - 1;
    if (own_->quirks.readsStorageLate) gl::finish();  // the slot's data are those of the sample before
    shadow::LightStats ofSample;
    if (auto done = paint(work, sample.light, slot, ofSample); !done) return done;
    if (number == 0) stats = std::move(ofSample);
    if (auto done = own_->sample.setOne(sampleBlock(sample, work.seen.view.eye, number)); !done) return done;
    if (!own_->add) own_->add.emplace(shaders::kScreenVert, shaders::kMaskAddFrag);
    gl::PassState state = work.seen.placement;
    state.colourWrite = true;
    state.blend = gl::Blend::add;
    gl::Pass pass(work.seen.scope, work.target.maskSumTarget(), state);
    pass.use(*own_->add);
    pass.uniforms(0, own_->lights[slot].view);
    pass.uniforms(1, own_->lights[slot].shading);
    pass.storage(0, own_->scene->positions());
    pass.storage(1, own_->scene->triangles());
    pass.storage(2, own_->scene->corners());
    pass.uniforms(2, own_->sample);
    pass.texture(0, work.target.ids());
    pass.texture(1, work.target.mask(slot));
    pass.draw(own_->scene->drawn().vertices(), 3);
    return {};
  }

  void finishSum(const Work& work, std::size_t index) {
    if (!own_->mean) own_->mean.emplace(shaders::kScreenVert, shaders::kMaskMeanFrag);
    gl::PassState state = work.seen.placement;
    state.colourWrite = true;
    gl::Pass pass(work.seen.scope, work.target.maskTarget(index), state);
    pass.use(*own_->mean);
    pass.texture(1, work.target.maskSum());
    pass.draw(own_->scene->drawn().vertices(), 3);
  }

  // A rasteriser snaps corners to 1/256 pixel, so a pixel may show a triangle that ends just beside its centre. What painters that know only some surfaces say there
  // is true of where that surface would go on, under a neighbour perhaps.
  [[nodiscard]] image::GreyImage unshadowedPixels(const scene::Camera& camera,
                                                  const shadow::SurfaceBuffer& seen) const {
    const auto flags = own_->painter->unshadowed();
    if (flags.empty()) return {};
    image::GreyImage pixels(seen.triangle.width(), seen.triangle.height());
    const scene::PixelRays rays = scene::pixelRays(camera);
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const std::uint32_t t = seen.triangle(x, y);
        if (t != shadow::kNoTriangle)
          pixels(x, y) = flags[t] != 0 || !isHit(t, camera.eye, rays.through(x + 0.5, y + 0.5)) ? 1 : 0;
      }
    return pixels;
  }

  [[nodiscard]] bool isHit(std::uint32_t triangle, const Vec3& eye, const Vec3& ray) const {
    const scene::Surfaces& surfaces = geometry_->surfaces;
    const Vec3 from = eye - surfaces.origin;
    const Vec3 a = surfaces.corner(triangle, 0) - from, b = surfaces.corner(triangle, 1) - from,
               c = surfaces.corner(triangle, 2) - from;
    const double ab = glm::dot(glm::cross(a, b), ray), bc = glm::dot(glm::cross(b, c), ray),
                 ca = glm::dot(glm::cross(c, a), ray);
    return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
  }

  MaskPainterMaker makePainter_;
  Box3 room_;  ///< that holds all surfaces, in the world
  std::unique_ptr<Own> own_;
};

}  // namespace

std::string_view screenVertexSource() { return shaders::kScreenVert; }

std::unique_ptr<GlTechnique> makeMaskTechnique(const shadow::Traits& traits, MaskPainterMaker makePainter,
                                               std::shared_ptr<gl::Context> context) {
  return std::make_unique<MaskTechnique>(traits, std::move(makePainter), std::move(context));
}

}  // namespace umbrage::render
