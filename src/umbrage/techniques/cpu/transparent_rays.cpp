#include <optional>
#include <variant>

#include "umbrage/parallel/for_each.hpp"
#include "umbrage/shadow/phase_clock.hpp"
#include "umbrage/shadow/veil_layers.hpp"
#include "umbrage/techniques/cpu/detail/facing_memo.hpp"
#include "umbrage/techniques/cpu/detail/transparent_rays.hpp"
#include "umbrage/trace/transmission.hpp"

namespace umbrage::techniques::detail {
namespace {

/// The light that reaches surfaces of one picture.
class Reach {
 public:
  Reach(const trace::Transmission& rays, const scene::Camera& camera, const scene::Light& light)
      : rays_(rays),
        light_(light),
        pixels_(scene::pixelRays(camera)),
        eye_(camera.eye - surfaces().origin),
        towards_(scene::homogeneous(light, surfaces().origin)),
        facing_(surfaces(), Vec4(eye_, 1.0), towards_) {}

  /// Of a triangle at the depth where pixel (x, y) shows it.
  [[nodiscard]] shadow::Tint at(int x, int y, std::uint32_t triangle, bool shadowed) {
    if (triangle == shadow::kNoTriangle || !facing_.faces(triangle)) return {};
    const Vec3 ray = pixels_.through(x + 0.5, y + 0.5), normal = surfaces().normal(triangle);
    const double depth = glm::dot(normal, surfaces().corner(triangle, 0) - eye_) / glm::dot(normal, ray);
    const Vec3 point = eye_ + depth * ray;
    if (!scene::insideCone(light_, point + surfaces().origin)) return {};
    if (!shadowed) return shadow::kFullTint;
    const auto taken = rays_.towards(towards_, point, triangle);
    return taken ? shadow::tintOf(rays_.geometry().filters.transmitted(*taken)) : shadow::Tint{};
  }

 private:
  [[nodiscard]] const scene::Surfaces& surfaces() const { return rays_.geometry().surfaces; }
  const trace::Transmission& rays_;
  const scene::Light& light_;
  scene::PixelRays pixels_;
  Vec3 eye_;
  Vec4 towards_;
  FacingMemo facing_;
};

class TransparentRays final : public shadow::Technique {
 public:
  TransparentRays() : traits_(transparentRaysTraits()) {}
  const shadow::Traits& traits() const override { return traits_; }

  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    auto built = trace::Transmission::build(std::move(geometry));
    if (!built) return tl::unexpected(built.error());
    rays_.emplace(std::move(*built));
    return {};
  }

  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    UMBRAGE_CHECK(rays_.has_value(), "shade() before prepare()");
    shadow::Shading out;
    shadow::PhaseClock clock(out.stats.phases);
    if (auto done = look(frame.camera, out); !done) return tl::unexpected(done.error());
    clock.end("surface");
    for (const scene::Light& light : frame.lights) {
      auto mask = maskOf(frame, light, out);
      if (!mask) return tl::unexpected(mask.error());
      out.masks.push_back(std::move(*mask));
      out.stats.lights.push_back(
          {.method = "transparent_rays", .reason = "the product of what all surfaces on a ray let through"});
      clock.end("shadow");
    }
    return out;
  }

 private:
  [[nodiscard]] Result<void> look(const scene::Camera& camera, shadow::Shading& out) const;
  [[nodiscard]] Result<shadow::LightMask> maskOf(const shadow::Frame& frame, const scene::Light& light,
                                                 const shadow::Shading& seen) const;
  shadow::Traits traits_;
  std::optional<trace::Transmission> rays_;
};

Result<void> TransparentRays::look(const scene::Camera& camera, shadow::Shading& out) const {
  const scene::PixelRays pixels = scene::pixelRays(camera);
  const Vec3 eye = camera.eye - rays_->geometry().surfaces.origin;
  out.surface = {{camera.width, camera.height, shadow::kNoTriangle},
                 {camera.width, camera.height, std::numeric_limits<float>::infinity()}};
  struct Row {
    std::vector<std::uint32_t> count;
    std::vector<shadow::Veil> veils;
  };
  std::vector<Row> rows(static_cast<std::size_t>(camera.height));
  auto done = parallel::forEach(camera.height, [&](int y) {
    Row& row = rows[static_cast<std::size_t>(y)];
    std::vector<trace::Hit> hits;
    for (int x = 0; x < camera.width; ++x) {
      rays_->look(eye, pixels.through(x + 0.5, y + 0.5), hits);
      if (!hits.empty() && !rays_->geometry().filters.isVeil(hits.back().triangle)) {
        out.surface.triangle(x, y) = hits.back().triangle, out.surface.depth(x, y) = float(hits.back().at);
        hits.pop_back();
      }
      row.count.push_back(static_cast<std::uint32_t>(hits.size()));
      for (const trace::Hit& hit : hits) row.veils.push_back({hit.triangle, float(hit.at)});
    }
  });
  if (!done) return done;
  out.veils.first.assign(1, 0);
  for (const Row& row : rows) {
    for (const std::uint32_t count : row.count) out.veils.first.push_back(out.veils.first.back() + count);
    out.veils.veils.insert(out.veils.veils.end(), row.veils.begin(), row.veils.end());
  }
  return {};
}

Result<shadow::LightMask> TransparentRays::maskOf(const shadow::Frame& frame, const scene::Light& light,
                                                  const shadow::Shading& seen) const {
  const int width = frame.camera.width, height = frame.camera.height;
  shadow::LightMask mask{
      {width, height}, {width, height}, {width, height}, image::UnsetVector<shadow::Tint>(seen.veils.veils.size())};
  Reach reach(*rays_, frame.camera, light);
  const std::size_t most = shadow::litVeilLayers(frame.veilLayers, seen.veils, rays_->geometry().filters);
  auto done = parallel::forEach(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::uint32_t triangle = seen.surface.triangle(x, y);
      mask.tint(x, y) = reach.at(x, y, triangle, true);
      mask.light(x, y) = shadow::luminanceCode(mask.tint(x, y));
      mask.covered(x, y) = triangle != shadow::kNoTriangle ? 1 : 0;
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const auto veils = seen.veils.at(pixel);
      shadow::Tint* out = veils.empty() ? nullptr : &mask.veils[seen.veils.first[pixel]];
      for (std::size_t k = 0; k < veils.size(); ++k)
        out[k] = most > 0 && k >= most ? out[most - 1] : reach.at(x, y, veils[k].triangle, most > 0);
    }
  });
  if (!done) return tl::unexpected(done.error());
  return mask;
}

}  // namespace

shadow::Traits transparentRaysTraits() {
  shadow::Traits traits;
  traits.name = "transparent_rays";
  traits.summary =
      "Coloured light through transparent casters by rays, each crossing decided in double precision: the truth for "
      "transparent_cpu.";
  traits.tinted = true;
  return traits;
}

Result<std::unique_ptr<shadow::Technique>> makeTransparentRays() { return std::make_unique<TransparentRays>(); }

}  // namespace umbrage::techniques::detail
