#include <algorithm>
#include <cmath>
#include <optional>

#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/techniques/cpu/detail/radiosity.hpp"
#include "umbrage/trace/tiles.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::techniques::detail {
namespace {

class Radiosity final : public shadow::Technique {
 public:
  explicit Radiosity(const radiosity::SeenOptions& options) : traits_(radiosityTraits()), options_(options) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    auto built = trace::Occlusion::build({geometry, &geometry->surfaces});
    if (!built) return tl::unexpected(built.error());
    occlusion_.emplace(std::move(*built));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(occlusion_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    auto visible = trace::visibleSurfaces(*occlusion_, frame.camera);
    if (!visible) return tl::unexpected(visible.error());
    out.surface = std::move(*visible);
    clock.end("surface");
    radiosity::SeenOptions options = options_;
    options.samples = std::max<std::size_t>(1, frame.soft.samples);
    for (const scene::Light& light : frame.lights) {
      const auto seen = radiosity::seenLight(*occlusion_, light, options);
      if (!seen) return tl::unexpected(seen.error());
      clock.end("elements");
      auto mask = maskOf(*seen, frame.camera, out.surface);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back({.method = "radiosity",
                                  .reason = "seen from " + std::to_string(seen->mesh.vertices().size()) +
                                            " vertices of elements, between them interpolated"});
      clock.end("mask");
    }
    return out;
  }

 private:
  [[nodiscard]] Result<shadow::LightMask> maskOf(const radiosity::SeenLight& seen, const scene::Camera& camera,
                                                 const shadow::SurfaceBuffer& visible) const {
    const scene::PixelRays rays = scene::pixelRays(camera);
    const Vec3 eye = camera.eye - occlusion_->surfaces().origin;
    shadow::LightMask mask{{camera.width, camera.height}, {}, {camera.width, camera.height}, {}};
    const auto done = trace::forEachTile(camera.width, camera.height, [&](const trace::Tile& tile) {
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          const std::uint32_t triangle = visible.triangle(x, y);
          if (triangle == shadow::kNoTriangle) continue;
          mask.covered(x, y) = 1;
          const std::uint32_t root = seen.mesh.root(triangle);
          if (root == radiosity::kNone) continue;
          const Vec3 ray = rays.through(x + 0.5, y + 0.5);
          const Vec3 normal = seen.mesh.sheetOf(seen.mesh.elements()[root]).normal;
          const double part =
              seen.at(triangle, eye + double(visible.depth(x, y)) * ray, glm::dot(normal, ray) < 0.0 ? 0 : 1);
          mask.light(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
        }
      }
    });
    if (!done) return tl::unexpected(done.error());
    return mask;
  }

  shadow::Traits traits_;
  radiosity::SeenOptions options_;
  std::optional<trace::Occlusion> occlusion_;
};

}  // namespace

shadow::Traits radiosityTraits() {
  shadow::Traits traits;
  traits.name = "radiosity";
  traits.summary =
      "Light at the vertices of elements that are cut where shadows end, interpolated: approximate, the same from "
      "every eye.";
  traits.soft = true;
  traits.approximate = true;
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeRadiosity(const radiosity::SeenOptions& options) {
  return std::make_unique<Radiosity>(options);
}

}  // namespace umbrage::techniques::detail
