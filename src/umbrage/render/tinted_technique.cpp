#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/detail/card_technique.hpp"
#include "umbrage/render/run_passes.hpp"
#include "umbrage/render/soft_sums.hpp"
#include "umbrage/render/tinted_passes.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/finders/threads.hpp"
#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/shadow/veil_layers.hpp"

namespace umbrage::render {
namespace {

// Surfaces nearer to each other than this share of the largest coordinate count as one, as they do to rays (trace::resolution).
constexpr double kResolution = 0x1p-20;

std::string reasonFor(Counting counting, const shadow::LightStats& stats) {
  std::string text = "what casters take from the light is summed up before the surfaces that are seen";
  if (counting == Counting::zFail)
    text = "what casters take from the light is summed up behind the surfaces that are seen; right for every eye";
  else if (stats.castersByZFail > 0)
    text += "; " + std::to_string(stats.castersByZFail) +
            " casters by z-fail, since the eye touches them or a side of their shadow volumes";
  if (counting == Counting::zPass)
    text += "; " + std::to_string(stats.eyeCount) + " surfaces between the eye and the light";
  return text;
}

// Of an sRGB value as the picture's code has it, as shadow::composite takes it.
float linearCode(double srgb) {
  return static_cast<float>(
      shadow::decodeSrgb(static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb, 0.0, 1.0)))));
}

using Toward = TintedPasses::Toward;
using PackedTint = std::array<std::uint32_t, 2>;
shadow::Tint unpacked(const PackedTint& t) {
  return {static_cast<std::uint16_t>(t[0]), static_cast<std::uint16_t>(t[0] >> 16), static_cast<std::uint16_t>(t[1])};
}

// Pixels of the graphics card begin at the bottom.
template <class Fn>
void forEachRow(int height, const Fn& fn) {
  constexpr std::size_t kRows = 64;
  const auto rows = static_cast<std::size_t>(height);
  const auto threads = static_cast<unsigned>(std::min<std::size_t>(shadow::threadCount(0), 1 + rows / kRows));
  shadow::inParts(rows, 1, threads, [&](unsigned, std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) fn(y, rows - 1 - y);
  });
}

/// The veils of a frame in the order of the card, and in that of the masks.
struct VeilOrder {
  std::vector<std::array<std::uint32_t, 2>> pixels;  ///< of the card
  std::vector<std::uint32_t> first;                  ///< of the picture, per pixel; one more

  VeilOrder(const VeilLists& lists, int width, int height) {
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    if (lists.count() == 0) return;
    pixels = lists.pixels().readAll<std::array<std::uint32_t, 2>>(columns * rows);
    first.reserve(columns * rows + 1);
    first.push_back(0);
    for (std::size_t y = 0; y < rows; ++y)
      for (std::size_t x = 0; x < columns; ++x) first.push_back(first.back() + pixels[(rows - 1 - y) * columns + x][1]);
  }
  // fn(place in the card's list, place in the picture's, how many)
  template <class Fn>
  void forEachInRow(std::size_t y, std::size_t fromBottom, std::size_t width, const Fn& fn) const {
    if (first.empty()) return;
    for (std::size_t x = 0; x < width; ++x) {
      const auto& own = pixels[fromBottom * width + x];
      if (own[1] != 0) fn(own[0], first[y * width + x], own[1]);
    }
  }
};

void countPenumbra(const shadow::LightMask& mask, shadow::SoftStats& stats) {
  for (std::size_t i = 0; i < mask.covered.size(); ++i) {
    const shadow::Tint& tint = mask.tint.pixels()[i];
    if (mask.covered.pixels()[i] == 0 || tint == shadow::kFullTint) continue;
    ++(tint == shadow::Tint{} ? stats.umbra : stats.penumbra);
  }
}

class TintedTechnique final : public detail::CardTechnique {
 public:
  TintedTechnique(const shadow::Traits& traits, Counting counting, const VolumeOptions& options,
                  std::shared_ptr<gl::Context> context)
      : CardTechnique(traits, std::move(context)), counting_(counting), options_(options) {}
  ~TintedTechnique() override {
    const gl::CurrentContext current(context_);
    own_.reset();
  }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    const gl::CurrentContext current(context_);
    const gl::HostScope scope;
    auto scene = GpuScene::make(geometry->surfaces);
    if (!scene) return tl::unexpected(scene.error());
    auto passes = TintedPasses::make(*geometry);
    if (!passes) return tl::unexpected(passes.error());
    if (own_ == nullptr) own_ = std::make_unique<Own>();
    own_->scene.emplace(std::move(*scene));
    own_->passes = std::move(*passes);
    finder_ = shadow::makeFinder(shadow::FinderKind::bruteForce,
                                 std::shared_ptr<const shadow::CasterSet>(geometry, &geometry->casters));
    geometry_ = std::move(geometry);
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(geometry_ != nullptr, "prepare() first");
    const gl::CurrentContext current(context_);
    gl::HostScope scope;
    auto& target = own_->frame;
    if (auto done = resize(target, frame.camera); !done) return tl::unexpected(done.error());
    shadow::Shading shading;
    shadow::PhaseClock clock(shading.stats.phases);
    const PhaseEnd ended = [&](const char* phase) { clock.end(phase); };
    auto seen = begin(scope, *target, frame, nullptr, ended);
    if (!seen) return tl::unexpected(seen.error());
    const VeilOrder order = readSurfaces(*seen, frame.camera, shading);
    clock.end("readback");
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      if (auto done = light(*seen, frame, i, Toward::tints, shading.stats, ended); !done)
        return tl::unexpected(done.error());
      shading.masks.push_back(readMask(order, shading));
      if (auto& soft = shading.stats.lights.back().soft) countPenumbra(shading.masks.back(), *soft);
      clock.end("readback");
    }
    return shading;
  }

 private:
  Result<void> paint(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame, const PictureOptions& options,
                     shadow::FrameStats& stats, const PhaseEnd& ended) override {
    auto seen = begin(scope, target, frame, &options, ended);
    if (!seen) return tl::unexpected(seen.error());
    // One hard light, or the first of several, is drawn with the ambient light.
    const bool inOne = !frame.lights.empty() && !isSoft(frame.lights[0]);
    if (!inOne)
      if (auto done = own_->passes->beginPicture(*seen, own_->shading); !done) return done;
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
      const bool soft = isSoft(frame.lights[i]);
      const Toward toward = soft ? Toward::tints : inOne && i == 0 ? Toward::newPicture : Toward::picture;
      if (auto done = light(*seen, frame, i, toward, stats, ended); !done) return done;
      if (soft)
        if (auto done = own_->passes->addLight(*seen, static_cast<int>(i)); !done) return done;
    }
    own_->passes->endPicture(*seen, own_->shading);
    if (ended) {
      gl::finish();
      ended("lit");
    }
    return {};
  }

  // All that lives in the context.
  struct Own {
    std::optional<GpuScene> scene;
    std::optional<GpuFrame> frame;
    std::unique_ptr<TintedPasses> passes;
    VeilLists veils;
    SoftSums soft;
    Programs programs;
    gl::Buffer view, shading;
    std::vector<GpuLight> none;
  };

  static Result<void> resize(std::optional<GpuFrame>& frame, const scene::Camera& camera) {
    if (frame && frame->width() == camera.width && frame->height() == camera.height) return {};
    frame.reset();
    auto made = GpuFrame::make(camera.width, camera.height);
    if (!made) return tl::unexpected(made.error());
    frame.emplace(std::move(*made));
    return {};
  }

  [[nodiscard]] TintedBlock blockOf(const View& view, const shadow::Frame& frame) const {
    const scene::Surfaces& surfaces = geometry_->surfaces;
    const ViewBlock eye = viewBlock(view, surfaces.origin, Vec4(0.0));
    const Vec3 reach = glm::max(glm::abs(surfaces.bounds.min), glm::abs(surfaces.bounds.max));
    TintedBlock block;
    block.eyeHigh = eye.eyeHigh;
    block.eyeLow = eye.eyeLow;
    block.scale = Vec4f(static_cast<float>(1.0 / geometry_->filters.steps()),
                        static_cast<float>(kResolution * std::max({reach.x, reach.y, reach.z})), 0.0f, 0.0f);
    // Which layers matter is known when all are drawn, so all are lit where that is asked for.
    const int layers = frame.veilLayers.value_or(shadow::kVeilLayersThatMatter);
    block.litLayers = layers == shadow::kVeilLayersThatMatter ? std::numeric_limits<int>::max() : std::max(0, layers);
    block.width = frame.camera.width;
    block.pixelCount = frame.camera.width * frame.camera.height;
    return block;
  }

  // Draws what the camera sees.
  Result<TintedFrame> begin(gl::HostScope& scope, GpuFrame& target, const shadow::Frame& frame,
                            const PictureOptions* options, const PhaseEnd& ended) {
    const scene::Camera& camera = frame.camera;
    view_ = viewOf(camera, geometry_->surfaces.bounds.radius());
    ShadingBlock shading = shadingBlock(camera);
    if (options != nullptr) {
      shading.sky = Vec4f(Vec3f(options->up), static_cast<float>(options->light.ambient));
      const Vec3& background = options->light.background;
      shading.background = Vec4f(Vec3f(background), 1.0f);
      shading.radiance = Vec4f(linearCode(background.x), linearCode(background.y), linearCode(background.z), 0.0f);
      if (auto done = own_->passes->setMaterials(options->materials); !done) return tl::unexpected(done.error());
    }
    TintedFrame seen{.scope = scope,
                     .scene = *own_->scene,
                     .target = target,
                     .veils = own_->veils,
                     .placement = {},
                     .block = blockOf(view_, frame),
                     .shading = shading};
    seen.placement.viewport = {0, 0, camera.width, camera.height};
    for (const auto& done : {own_->view.setOne(viewBlock(view_, geometry_->surfaces.origin, Vec4(0.0))),
                             own_->shading.setOne(shading), target.needTints(), target.needTiles(),
                             own_->scene->arrangeApart(*geometry_, view_, camera.width, camera.height)})
      if (!done) return tl::unexpected(done.error());
    if (ended) ended("facing");
    const RunInput input{.programs = own_->programs,
                         .positions = own_->scene->positions(),
                         .scene = &*own_->scene,
                         .frame = &target,
                         .view = &own_->view,
                         .shading = &own_->shading,
                         .lights = own_->none};
    run(scope, planSurfaces(seen.placement, view_.reversed), input, ended);
    own_->veils.forget();
    if (!geometry_->filters.empty()) {
      const VeilLists::Input veils{*own_->scene, target, own_->view, own_->shading, seen.placement};
      if (auto done = own_->veils.find(scope, veils); !done) return tl::unexpected(done.error());
      seen.block.hasVeils = own_->veils.count() > 0 ? 1 : 0;
      if (ended) {
        gl::finish();
        ended("veils");
      }
    }
    return seen;
  }

  // Per surface what is known per caster triangle.
  [[nodiscard]] std::vector<std::int8_t> ofSurfaces(std::span<const std::int8_t> ofCasters) const {
    std::vector<std::int8_t> out(geometry_->surfaces.triangles.size(), 0);
    for (std::size_t t = 0; t < ofCasters.size(); ++t) out[geometry_->casters.surfaceTriangle[t]] = ofCasters[t];
    return out;
  }

  [[nodiscard]] bool isSoft(const scene::Light& light) const { return traits_.soft && scene::isArea(light); }

  Result<void> light(const TintedFrame& seen, const shadow::Frame& frame, std::size_t number, Toward toward,
                     shadow::FrameStats& stats, const PhaseEnd& ended) {
    const scene::Light& light = frame.lights[number];
    shadow::LightStats& told = stats.lights.emplace_back();
    if (isSoft(light)) return softLight(seen, frame, number, told, ended);
    return hardLight(seen, frame, number, light, toward, told, ended);
  }

  // The mean of the hard light of many points; sixteen at a time, as on the processor.
  Result<void> softLight(const TintedFrame& seen, const shadow::Frame& frame, std::size_t number,
                         shadow::LightStats& told, const PhaseEnd& ended) {
    constexpr std::size_t kPart = 16;
    const scene::Light& light = frame.lights[number];
    Box3 room = geometry_->surfaces.bounds;
    if (!room.empty()) room.min += geometry_->surfaces.origin, room.max += geometry_->surfaces.origin;
    const std::size_t most = std::max<std::size_t>(1, frame.soft.samples);
    SoftSums& sums = own_->soft;
    double error = std::numeric_limits<double>::infinity();
    for (sums.begin(); sums.samples() < most;) {
      for (const auto& sample :
           shadow::lightSamples(light, sums.samples(), std::min(kPart, most - sums.samples()), room)) {
        shadow::LightStats one;
        if (auto done = hardLight(seen, frame, number, sample.light, Toward::tints, one, ended); !done) return done;
        if (sums.samples() == 0) told = std::move(one);
        if (auto done = sums.add(seen, *own_->passes, own_->shading, sample, view_.eye); !done) return done;
      }
      const auto found = sums.error(seen);
      if (!found) return tl::unexpected(found.error());
      error = *found;
      if (ended) ended("mean");
      const bool goOn = !frame.soft.progress || frame.soft.progress({number, sums.samples(), error});
      if (!goOn || (sums.samples() >= 2 * kPart && error <= frame.soft.enough)) break;
    }
    told.reason = "the mean of " + std::to_string(sums.samples()) + " points of the light; each: " + told.reason;
    told.soft = shadow::SoftStats{sums.samples(), error};
    if (auto done = sums.mean(seen, *own_->passes); !done) return done;
    return own_->passes->setShading(withLight(seen.shading, frame.camera, light));
  }

  Result<void> hardLight(const TintedFrame& seen, const shadow::Frame& frame, std::size_t number,
                         const scene::Light& light, Toward toward, shadow::LightStats& told, const PhaseEnd& ended) {
    const auto end = [&](const char* phase) {
      if (ended) ended(phase);
    };
    const scene::Surfaces& surfaces = geometry_->surfaces;
    const Vec4 homogeneous = scene::homogeneous(light, surfaces.origin);
    const Vec3 eye = view_.eye - surfaces.origin;
    // What z-pass counts lies between the eye and the receivers.
    Box3 counted = surfaces.bounds;
    counted.add(eye);
    const TintedLight gpu{.number = static_cast<int>(number),
                          .view = viewBlock(view_, surfaces.origin, homogeneous),
                          .shading = withLight(seen.shading, frame.camera, light),
                          .volumeArea = volumeArea(view_, geometry_->casters.bounds, counted, homogeneous,
                                                   surfaces.origin, seen.placement),
                          .litArea = litArea(view_, light, seen.placement)};
    const auto facing = shadow::visibleSideFacesLight(surfaces, Vec4(eye, 1.0), homogeneous);
    if (auto done = own_->passes->setLight(seen, gpu, facing, {}); !done) return done;
    end("facing");

    const VolumeOptions volumes = frame.fill == shadow::VolumeFill::plain ? kPlainVolumes : options_;
    std::optional<ReceiverTiles> tiles;
    if (volumes.hiddenParts) {
      auto depths = own_->passes->receivers(seen);
      if (!depths) return tl::unexpected(depths.error());
      tiles.emplace(view_, std::move(*depths), frame.camera.width, frame.camera.height);
      end("tiles");
    }
    const TintedVolume volume = prepareTinted(*geometry_,
                                              {.finder = *finder_,
                                               .light = homogeneous,
                                               .eye = eye,
                                               .counting = counting_,
                                               .options = volumes,
                                               .receivers = surfaces.bounds,
                                               .tiles = tiles ? &*tiles : nullptr,
                                               .view = &view_,
                                               .detailed = frame.detailed},
                                              told, ended);
    told.reason = reasonFor(counting_, told);
    if (auto done = own_->passes->setVolume(volume); !done) return done;
    if (auto done = own_->passes->setLight(seen, gpu, facing, ofSurfaces(volume.side)); !done) return done;
    if (ended) {
      gl::finish();
      ended("upload");
    }
    return own_->passes->reach(seen, gpu, toward, ended);
  }

  [[nodiscard]] VeilOrder readSurfaces(const TintedFrame& seen, const scene::Camera& camera,
                                       shadow::Shading& out) const {
    const int width = camera.width, height = camera.height;
    out.surface = {gl::readIds(seen.scope, seen.target.surfaceTarget(), width, height),
                   gl::readDepth(seen.scope, seen.target.surfaceTarget(), width, height)};
    VeilOrder order(seen.veils, width, height);
    const auto veils = seen.veils.veils().readAll<std::array<std::uint32_t, 2>>(seen.veils.count());
    out.veils.first = order.first;
    out.veils.veils.resize(veils.size());
    forEachRow(height, [&](std::size_t y, std::size_t fromBottom) {
      float* depth = out.surface.depth.row(static_cast<int>(y));
      for (int x = 0; x < width; ++x) depth[x] = depthToDistance(view_, depth[x]);
      order.forEachInRow(
          y, fromBottom, static_cast<std::size_t>(width), [&](std::size_t from, std::size_t to, std::size_t count) {
            for (std::size_t k = 0; k < count; ++k)
              out.veils.veils[to + k] = {veils[from + k][0] & 0x7fffffffu,
                                         depthToDistance(view_, std::bit_cast<float>(veils[from + k][1]))};
          });
    });
    return order;
  }

  [[nodiscard]] shadow::LightMask readMask(const VeilOrder& order, const shadow::Shading& shading) const {
    const int width = shading.surface.triangle.width(), height = shading.surface.triangle.height();
    const auto columns = static_cast<std::size_t>(width);
    const std::size_t pixels = columns * static_cast<std::size_t>(height), veils = shading.veils.veils.size();
    const auto tints = own_->passes->tints().readAll<PackedTint>(pixels + veils);
    shadow::LightMask mask{image::GreyImage::unset(width, height), image::Image<shadow::Tint>::unset(width, height),
                           image::GreyImage::unset(width, height), image::UnsetVector<shadow::Tint>(veils)};
    forEachRow(height, [&](std::size_t y, std::size_t fromBottom) {
      shadow::Tint last{};
      std::uint8_t code = shadow::luminanceCode(last);
      for (std::size_t x = 0; x < columns; ++x) {
        const shadow::Tint tint = unpacked(tints[fromBottom * columns + x]);
        if (tint != last) last = tint, code = shadow::luminanceCode(tint);
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        mask.tint(column, row) = tint;
        mask.light(column, row) = code;
        mask.covered(column, row) = shading.surface.triangle(column, row) != shadow::kNoTriangle ? 1 : 0;
      }
      order.forEachInRow(y, fromBottom, columns, [&](std::size_t from, std::size_t to, std::size_t count) {
        for (std::size_t k = 0; k < count; ++k) mask.veils[to + k] = unpacked(tints[pixels + from + k]);
      });
    });
    return mask;
  }

  Counting counting_;
  VolumeOptions options_;
  std::unique_ptr<shadow::SilhouetteFinder> finder_;
  std::unique_ptr<Own> own_;
  View view_;  ///< of the frame being drawn
};

}  // namespace

std::unique_ptr<GlTechnique> makeTintedTechnique(const shadow::Traits& traits, Counting counting,
                                                 std::shared_ptr<gl::Context> context, const VolumeOptions& options) {
  return std::make_unique<TintedTechnique>(traits, counting, options, std::move(context));
}

}  // namespace umbrage::render
