#include <chrono>

#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/depth_bounds.hpp"
#include "umbrage/render/detail/card_technique.hpp"
#include "umbrage/render/frame_data.hpp"
#include "umbrage/render/gpu_finder.hpp"
#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/uniforms.hpp"
#include "umbrage/shadow/phase_clock.hpp"

namespace umbrage::render {
namespace {

std::string reasonFor(Counting counting, Overflow overflow, const shadow::LightStats& stats,
                      const LightVolume& volume) {
  const std::size_t groups = volume.groups.size();
  const std::string fallen = std::to_string(stats.castersByZFail);
  std::string text = "no caps needed; the eye is outside all shadow volumes";
  if (counting == Counting::zFail || counting == Counting::eachTriangle)
    text = "right for every eye and every caster";
  else if (counting == Counting::zMixed && stats.castersByZFail > 0)
    text = fallen + " casters by z-fail, since they may lie between the eye and the light, the others by z-pass";
  else if (counting == Counting::zPassPlus && volume.nearDegenerates)
    text = "no caps needed; counted at the eye, since the light shines along the near rectangle or lies beside it";
  else if (counting == Counting::zPassPlus && stats.castersByZFail == 0)
    text = "no caps needed; the casters are drawn as the light sees them through the near rectangle";
  else if (stats.castersByZFail > 0 && !volume.roles.empty())
    text = fallen +
           " casters by z-fail, since by their boxes they may lie between the eye and the light, the others by z-pass";
  else if (stats.castersByZFail > 0)
    text = fallen + " casters by z-fail, since the eye touches a side of their shadow volumes";
  else if (stats.eyeCount != 0)
    text = "no caps needed; the eye is inside " + std::to_string(stats.eyeCount) + " shadow volumes, which is counted";
  if (overflow == Overflow::wraps) text += "; counts of 256 wrap to 0 and are lit, as asked";
  if (overflow == Overflow::saturates) text += "; counts stop at 255, as asked";
  if (groups > 1)
    text +=
        "; in " + std::to_string(groups) + " groups, since more casters may lie behind each other than 8 bits count";
  return text;
}

class StencilTechnique final : public detail::CardTechnique {
 public:
  StencilTechnique(const shadow::Traits& traits, Counting counting, const VolumeOptions& options,
                   std::shared_ptr<gl::Context> context)
      : CardTechnique(traits, std::move(context)), counting_(counting), options_(options) {}
  ~StencilTechnique() override {
    const gl::CurrentContext current(context_);
    own_.reset();
  }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    const gl::CurrentContext current(context_);
    const gl::HostScope scope;
    auto scene = GpuScene::make(geometry->surfaces);
    if (!scene) return tl::unexpected(scene.error());
    if (own_ == nullptr) own_ = std::make_unique<Own>();
    own_->quirks = context_ != nullptr ? context_->quirks() : gl::findQuirks();
    own_->scene.emplace(std::move(*scene));
    geometry_ = std::move(geometry);
    return useFinder(shadow::FinderKind::automatic);
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(geometry_ != nullptr, "prepare() first");
    const gl::CurrentContext current(context_);
    gl::HostScope scope;
    auto& target = own_->frame;
    if (auto done = fit(target, frame.camera.width, frame.camera.height); !done) return tl::unexpected(done.error());
    if (auto done = target->needMasks(frame.lights.size()); !done) return tl::unexpected(done.error());

    shadow::Shading shading;
    shadow::PhaseClock clock(shading.stats.phases);
    const PhaseEnd ended = [&](const char* phase) { clock.end(phase); };
    if (auto done = render(scope, *target, frame, Product::masks, nullptr, shading.stats, ended); !done)
      return tl::unexpected(done.error());
    const View view = viewOf(frame.camera, geometry_->surfaces.bounds.radius());
    readMasks(scope, *target, view, frame.lights.size(), seen_ ? std::move(*seen_) : readSurface(scope, *target),
              shading);
    seen_.reset();
    tellCounts(shading.stats);
    clock.end("readback");
    return shading;
  }

 private:
  Result<void> paint(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame, const PictureOptions& options,
                     shadow::FrameStats& stats, const PhaseEnd& ended) override {
    if (auto done = render(scope, target, frame, Product::picture, &options, stats, ended); !done) return done;
    if (ended) tellCounts(stats);
    return {};
  }

  // All that lives in the context.
  struct Own {
    std::optional<GpuScene> scene;
    std::optional<GpuFrame> frame;
    gl::Quirks quirks;
    Programs programs;
    FrameData data;
    std::vector<GpuLight> lights;
    std::unique_ptr<GpuFinder> finder;  ///< null: the processor finds silhouettes
  };

  Result<void> useFinder(shadow::FinderKind kind) {
    const std::shared_ptr<const shadow::CasterSet> casters(geometry_, &geometry_->casters);
    const bool byChoice = kind == shadow::FinderKind::automatic && !own_->quirks.software &&
                          counting_ != Counting::zPassPlus && counting_ != Counting::eachTriangle;
    if (byChoice || kind == shadow::FinderKind::gpu) {
      if (own_->finder != nullptr && &own_->finder->casters() == casters.get()) return {};
      auto made = GpuFinder::make(casters);
      if (made) own_->finder = std::move(*made);
      if (made) return {};
      if (!byChoice) return tl::unexpected(made.error());
    }
    own_->finder.reset();
    if (finder_ == nullptr || finder_->kind() != kind || &finder_->casters() != casters.get())
      finder_ = shadow::makeFinder(kind, casters);
    return {};
  }

  [[nodiscard]] const shadow::SilhouetteFinder& finder() const {
    return own_->finder != nullptr ? static_cast<const shadow::SilhouetteFinder&>(*own_->finder) : *finder_;
  }

  Result<void> render(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame, Product product,
                      const PictureOptions* options, shadow::FrameStats& stats, const PhaseEnd& ended) {
    const scene::Camera& camera = frame.camera;
    const View view = viewOf(camera, geometry_->surfaces.bounds.radius());
    gl::PassState placement;
    placement.viewport = {0, 0, camera.width, camera.height};
    if (auto done = upload(own_->data, view, geometry_->surfaces.origin, camera, options); !done) return done;
    if (auto done = own_->scene->arrangeFor(*geometry_, view, camera.width, camera.height); !done) return done;
    if (ended) ended("facing");

    if (auto done = useFinder(frame.silhouettes); !done) return done;
    VolumeOptions volumes = frame.fill == shadow::VolumeFill::plain ? kPlainVolumes : options_;
    volumes.extrusion = frame.extrusion.value_or(options_.extrusion);
    volumes.overflow = options_.overflow;
    while (own_->lights.size() < frame.lights.size()) own_->lights.emplace_back();
    const RunInput input{.programs = own_->programs,
                         .positions = own_->scene->positions(),
                         .scene = &*own_->scene,
                         .frame = &target,
                         .materials = options != nullptr ? &own_->data.materials : nullptr,
                         .view = &own_->data.view,
                         .shading = &own_->data.shading,
                         .lights = own_->lights};
    seen_.reset();
    run(scope, planSurfaces(placement, view.reversed), input, ended);

    std::vector<LightPlan> plans;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      stats.lights.emplace_back();
      auto tiles = addReceivers(scope, i, frame.lights[i], view, camera, volumes, target, input, ended);
      if (!tiles) return tl::unexpected(tiles.error());
      auto plan = addVolume(scope, own_->lights[i], frame.lights[i], view, volumes, frame.detailed, *tiles, placement,
                            stats.lights.back(), ended);
      if (!plan) return tl::unexpected(plan.error());
      plans.push_back(*plan);
    }
    const PassList list = planLights(placement, view.reversed, plans, product);
    run(scope, list, input, ended);
    if (!frame.detailed) return {};
    const auto fragments = countFragments(scope, list, input);
    for (std::size_t i = 0; i < stats.lights.size(); ++i) stats.lights[i].volumeFragments = fragments[i];
    if (ended) ended("fragments");
    return {};
  }

  // A rasteriser on the processor has the pixels at hand, and shade() wants them anyway; from a graphics card only tiles are fetched.
  Result<image::Image<Vec2f>> tileDepths(gl::HostScope& scope, std::size_t light, std::span<const std::uint8_t> facing,
                                         GpuFrame& target, const RunInput& input) {
    if (own_->quirks.software) {
      if (!seen_) seen_ = readSurface(scope, target);
      return receiverDepths(seen_->triangle, seen_->depth, facing);
    }
    if (auto done = target.needTiles(); !done) return tl::unexpected(done.error());
    const int columns = tilesFor(target.width()), rows = tilesFor(target.height());
    run(scope, planTiles(static_cast<int>(light), {0, 0, columns, rows}), input);
    return gl::readPairs(scope, target.tilesTarget(), columns, rows);
  }

  // What the lit passes need to know of a light, and how far away its receivers are.
  Result<std::optional<ReceiverTiles>> addReceivers(gl::HostScope& scope, std::size_t index, const scene::Light& light,
                                                    const View& view, const scene::Camera& camera,
                                                    const VolumeOptions& volumes, GpuFrame& target,
                                                    const RunInput& input, const PhaseEnd& ended) {
    GpuLight& gpu = own_->lights[index];
    const auto facing = upload(gpu, geometry_->surfaces, view, camera, light);
    if (!facing) return tl::unexpected(facing.error());
    if (ended) ended("facing");
    if (!volumes.hiddenParts) return std::nullopt;
    const auto depths = tileDepths(scope, index, *facing, target, input);
    if (!depths) return tl::unexpected(depths.error());
    ReceiverTiles tiles(view, *depths, target.width(), target.height());
    if (ended) ended("tiles");
    return tiles;
  }

  // False when the edges have to come back to the processor: for what only it works out, for groups of layers, or for lack of room.
  Result<bool> extrudeOnCard(gl::HostScope& scope, GpuLight& gpu, const VolumeRequest& request, LightVolume& volume,
                             shadow::LightStats& stats, const PhaseEnd& ended) {
    const shadow::Extrusion extrusion = request.options.extrusion;
    if (own_->finder == nullptr || counting_ == Counting::zPassPlus || counting_ == Counting::eachTriangle ||
        extrusion == shadow::Extrusion::processor)
      return false;
    if (own_->finder->layers(request.light) > kWholeStencil) return false;
    if (ended) ended("layers");
    shadow::LightStats onCard = stats;
    LightVolume prepared = prepareOnCard(request, onCard, ended);
    // Caps that are seen edge-on are left out, which the processor does.
    const bool hasCaps = counting_ == Counting::zFail || onCard.castersByZFail > 0;
    if (hasCaps && shadow::isInAFacesPlane(request.casters(), request.eye)) return false;
    const bool endless = prepared.farPoints.empty(), toOnePoint = endless && request.light.w == 0.0;
    const SideFormat whole = toOnePoint ? SideFormat::triangle : SideFormat::quad;
    const CardRequest wanted{.light = request.light,
                             .eye = request.eye,
                             .roles = prepared.roles,
                             .sides = extrusion == shadow::Extrusion::geometryShader ? SideFormat::line : whole,
                             .farCaps = !toOnePoint};
    if (!own_->finder->fits(wanted)) return false;
    if (auto done = own_->finder->extrude(scope, wanted, gpu.card); !done) return tl::unexpected(done.error());
    stats = std::move(onCard);
    volume = std::move(prepared);
    if (ended) {
      gl::finish();
      ended("silhouette");
    }
    return true;
  }

  // What only the graphics card knew.
  void tellCounts(shadow::FrameStats& stats) const {
    for (std::size_t i = 0; i < stats.lights.size(); ++i) {
      if (!own_->lights[i].onCard) continue;
      const CardCounts counts = countsOf(own_->lights[i].card);
      stats.lights[i].silhouetteEdges = counts.edges;
      stats.lights[i].volumeTriangles = counts.triangles;
    }
  }

  Result<LightPlan> addVolume(gl::HostScope& scope, GpuLight& gpu, const scene::Light& light, const View& view,
                              const VolumeOptions& volumes, bool detailed, const std::optional<ReceiverTiles>& tiles,
                              const gl::PassState& placement, shadow::LightStats& stats, const PhaseEnd& ended) {
    const shadow::CasterSet& casters = geometry_->casters;
    const Vec3& origin = geometry_->surfaces.origin;
    const Box3& receivers = geometry_->surfaces.bounds;
    // What z-pass counts lies between the eye and the receivers.
    Box3 counted = receivers;
    counted.add(view.eye - origin);
    const Vec4 homogeneous = scene::homogeneous(light, origin);
    const VolumeRequest request{.finder = finder(),
                                .light = homogeneous,
                                .eye = view.eye - origin,
                                .counting = counting_,
                                .options = volumes,
                                .receivers = receivers,
                                .tiles = tiles ? &*tiles : nullptr,
                                .view = &view,
                                .detailed = detailed};
    LightVolume volume;
    const auto onCard = extrudeOnCard(scope, gpu, request, volume, stats, ended);
    if (!onCard) return tl::unexpected(onCard.error());
    gpu.onCard = *onCard;
    if (!gpu.onCard) volume = prepareVolume(request, stats, ended);
    stats.reason = reasonFor(counting_, volumes.overflow, stats, volume);
    ViewBlock inPicture = viewBlock(view, origin, homogeneous);
    inPicture.toClip = Mat4f(1.0f);
    for (const auto& done :
         {gpu.volume.setAll(volume.indices), gpu.farPoints.setAll(volume.farPoints), gpu.points.setAll(volume.points),
          gpu.inPicture.setOne(inPicture), gpu.nearPoints.setAll(volume.nearPoints)})
      if (!done) return tl::unexpected(done.error());
    gpu.groups = volume.groups;
    if (ended) {
      gl::finish();
      ended("upload");
    }
    const std::vector<GroupPlan> groups = planGroups(volume);
    std::optional<std::array<float, 2>> bounds;
    if (volumes.depthBounds && own_->quirks.depthBounds)
      bounds =
          depthBounds(view, placement, volumeDistances(view, casters.bounds, counted, homogeneous, origin), groups);
    return LightPlan{
        .groups = groups,
        .twoSided = volumes.twoSided && own_->quirks.twoSidedStencil,
        .extrusion = volumes.extrusion,
        .finite = !volume.farPoints.empty(),
        .volumeArea = volumeArea(view, casters.bounds, counted, homogeneous, origin, placement),
        .litArea = gl::intersect(litArea(view, light, placement), boxArea(view, receivers, origin, placement)),
        .overflow = volumes.overflow,
        .depthBounds = bounds};
  }

  Counting counting_;
  VolumeOptions options_;
  std::unique_ptr<shadow::SilhouetteFinder> finder_;
  std::unique_ptr<Own> own_;
  std::optional<shadow::SurfaceBuffer> seen_;  // of the frame being drawn, once it has been read back
};

}  // namespace

std::unique_ptr<GlTechnique> makeStencilTechnique(const shadow::Traits& traits, Counting counting,
                                                  std::shared_ptr<gl::Context> context, const VolumeOptions& options) {
  return std::make_unique<StencilTechnique>(traits, counting, options, std::move(context));
}

}  // namespace umbrage::render
