#include "umbrage/render/map_painter.hpp"

#include <umbrage_shaders/map_depth_frag.hpp>
#include <umbrage_shaders/map_depth_vert.hpp>
#include <umbrage_shaders/map_shadow_frag.hpp>
#include <umbrage_shaders/screen_vert.hpp>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <optional>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/quirks.hpp"
#include "umbrage/math/predicates.hpp"

namespace umbrage::render {
namespace {

constexpr int kSmallestMap = 64, kStep = 64, kBytesPerTexel = 4;
constexpr int kWithoutPicture = 1024;  ///< texels a side where nothing tells how many are needed

// As the shaders have it.
struct MapBlock {
  Mat4f toMap, planeToMap;
  Vec4f drawn;
  float texels;
  float inside;  ///< what of the map's -1..1 is looked up; the rest is for filters
  float constantBias, slopeBias;
  std::int32_t filter;
  std::int32_t unused[3];
};

class MapPainter final : public MaskPainter {
 public:
  MapPainter(std::string name, MapFitter fit, const ShadowMapOptions& options)
      : name_(std::move(name)), fit_(fit), options_(options), limits_(gl::findQuirks()) {}

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    casters_.clear();
    for (std::uint32_t t = 0; t < geometry->surfaces.triangles.size(); ++t)
      if (geometry->surfaces.casts[t] != 0) casters_.push_back(t);
    drawn_.reset();
    return {};
  }

  Result<void> begin(const SeenFrame& frame) override {
    receivers_ = seenReceivers(frame.geometry.surfaces, frame.view, frame.camera);
    return {};
  }

  Result<void> paint(const SeenFrame& frame, const MaskLight& light, shadow::LightStats& stats) override {
    stats.method = name_;
    run(frame.scope, planMask(frame.placement, static_cast<int>(light.slot), light.area, 0), frame.input);
    const MapFit fit = fit_({.surfaces = frame.geometry.surfaces,
                             .view = frame.view,
                             .camera = frame.camera,
                             .receivers = receivers_,
                             .light = light.light,
                             .facing = light.facing});
    if (light.area.empty()) return {};
    if (auto done = chooseCasters(frame.geometry.surfaces, light.light); !done) return done;
    for (const MapView& map : fit.maps) {
      const int texels = texelsFor(map);
      for (const auto& done : {makeRoom(texels), upload(map, texels)})
        if (!done) return done;
      drawMap(frame, light, texels);
      lookUp(frame, light);
      ++stats.shadowMaps;
      stats.mapTexels += static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels);
    }
    stats.reason = reason(fit, stats);
    return {};
  }

 private:
  // A triangle in whose plane the light lies casts no shadow; rounding would give it one, even a large one where the light is one of its corners.
  Result<void> chooseCasters(const scene::Surfaces& surfaces, const scene::Light& light) {
    const Vec4 lamp = scene::homogeneous(light, surfaces.origin);
    std::vector<mesh::Triangle> some;
    for (const std::uint32_t t : casters_)
      if (lightSide(surfaces.corner(t, 0), surfaces.corner(t, 1), surfaces.corner(t, 2), lamp) != 0)
        some.push_back(surfaces.triangles[t]);
    if (drawn_ == casters_.size() && some.size() == casters_.size()) return {};
    drawn_ = some.size();
    return indices_.setAll(some);
  }

  [[nodiscard]] std::string reason(const MapFit& fit, const shadow::LightStats& stats) const {
    if (fit.maps.empty()) return "no map: nothing that is seen can lie in shadow";
    std::string text = std::to_string(stats.shadowMaps) + (stats.shadowMaps == 1 ? " map" : " maps");
    if (fit.movedBack)
      text += " in the perspective of an eye " + std::to_string(*fit.movedBack) + " behind the true one";
    text += options_.texels == 0 ? ", as fine as the picture" : ", of the size asked for";
    return text + ", " + std::to_string(stats.mapTexels) + " texels in all";
  }

  [[nodiscard]] int texelsFor(const MapView& map) const {
    const int driver = limits_.maxTextureSize;
    if (options_.texels > 0) return std::min(options_.texels, driver);
    const double memory = std::sqrt(double(options_.mostBytes / kBytesPerTexel));
    const double most = std::max(double(kSmallestMap), std::min(double(driver), memory));
    const double wanted = map.texelsForPicture > 0.0 ? map.texelsForPicture : kWithoutPicture;
    const double whole = kStep * std::ceil(std::min(wanted, most) / kStep);
    return static_cast<int>(std::clamp(whole, double(kSmallestMap), std::floor(most)));
  }

  // A map that is large enough for this one is used in part.
  Result<void> makeRoom(int texels) {
    if (map_.width() >= texels) return {};
    auto map = gl::Texture::make(gl::Format::depth32f, texels, texels);
    if (!map) return tl::unexpected(map.error());
    map_ = std::move(*map);
    auto target = gl::Framebuffer::make(nullptr, &map_);
    if (!target) return tl::unexpected(target.error());
    target_ = std::move(*target);
    return {};
  }

  Result<void> upload(const MapView& map, int texels) {
    // The border of the map is for the filter's neighbours.
    const double inside = std::max(0.25, 1.0 - 2.0 * (options_.filter + 1.5) / texels);
    Mat4 shrink(1.0);
    shrink[0][0] = shrink[1][1] = inside;
    const Mat4 toMap = shrink * map.toMap;
    const MapBlock block{.toMap = Mat4f(toMap),
                         .planeToMap = Mat4f(glm::transpose(glm::inverse(toMap))),
                         .drawn = Vec4f(map.drawn),
                         .texels = static_cast<float>(texels),
                         .inside = static_cast<float>(inside),
                         .constantBias = static_cast<float>(options_.constantBias),
                         .slopeBias = static_cast<float>(options_.slopeBias),
                         .filter = options_.filter,
                         .unused = {}};
    return block_.setOne(block);
  }

  void drawMap(const SeenFrame& frame, const MaskLight& light, int texels) {
    if (!depthProgram_) depthProgram_.emplace(shaders::kMapDepthVert, shaders::kMapDepthFrag);
    gl::PassState state;
    state.viewport = {0, 0, texels, texels};
    state.depth = {.test = true, .pass = gl::Compare::greater, .write = true, .clamp = true};
    state.clipDistances = 1;
    gl::Pass pass(frame.scope, target_, state);
    pass.clearDepth(0.0f);
    pass.use(*depthProgram_);
    pass.uniforms(0, frame.input.lights[light.slot].view);
    pass.storage(0, frame.input.positions);
    pass.uniforms(2, block_);
    pass.drawIndexed(vertices_, 0, 3 * *drawn_);
  }

  // Takes from the light's mask what the map says.
  void lookUp(const SeenFrame& frame, const MaskLight& light) {
    if (!shadowProgram_) shadowProgram_.emplace(shaders::kScreenVert, shaders::kMapShadowFrag);
    const GpuLight& gpu = frame.input.lights[light.slot];
    gl::PassState state = frame.placement;
    state.colourWrite = true;
    state.blend = gl::Blend::over;
    state.scissor = light.area;
    gl::Pass pass(frame.scope, frame.input.frame->maskTarget(light.slot), state);
    pass.use(*shadowProgram_);
    pass.uniforms(0, gpu.view);
    pass.uniforms(1, gpu.shading);
    pass.storage(0, frame.input.positions);
    pass.storage(1, frame.input.scene->triangles());
    pass.storage(2, frame.input.scene->corners());
    pass.storage(3, gpu.facing);
    pass.uniforms(2, block_);
    pass.texture(0, frame.input.frame->ids());
    pass.texture(1, map_);
    pass.draw(vertices_, 3);
  }

  std::string name_;
  MapFitter fit_;
  ShadowMapOptions options_;
  gl::Quirks limits_;
  SeenReceivers receivers_;
  gl::Buffer indices_, block_;
  gl::VertexArray vertices_{indices_};
  std::vector<std::uint32_t> casters_;  ///< triangles of the surfaces
  std::optional<std::size_t> drawn_;    ///< so many of them are in `indices_`
  gl::Texture map_;
  gl::Framebuffer target_;
  std::optional<gl::Program> depthProgram_, shadowProgram_;
};

}  // namespace

std::unique_ptr<MaskPainter> makeMapPainter(std::string name, MapFitter fit, const ShadowMapOptions& options) {
  UMBRAGE_CHECK(options.texels >= 0 && options.filter >= 0 && options.filter <= kLargestFilter, "shadow map options");
  return std::make_unique<MapPainter>(std::move(name), fit, options);
}

}  // namespace umbrage::render
