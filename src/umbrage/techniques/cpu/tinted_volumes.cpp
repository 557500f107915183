#include "umbrage/techniques/cpu/detail/tinted_volumes.hpp"

#include <algorithm>
#include <string>
#include <variant>

#include "umbrage/math/predicates.hpp"

namespace umbrage::techniques::detail {
namespace {

using raster::kBlock;

/// As trace::resolution: below this part of the largest coordinate surfaces count as one.
constexpr double kResolution = 0x1p-20;

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

}  // namespace

TintedVolumes::TintedVolumes(std::shared_ptr<const shadow::Geometry> geometry)
    : geometry_(std::move(geometry)),
      casterOf_(geometry_->surfaces.triangles.size(), shadow::kNoTriangle),
      surfaces_(*geometry_, raster::Drawn::opaque),
      veils_(*geometry_),
      sums_(geometry_->casters) {
  const std::vector<std::uint32_t>& origin = geometry_->casters.surfaceTriangle;
  for (std::uint32_t t = 0; t < origin.size(); ++t) casterOf_[origin[t]] = t;
}

Result<void> TintedVolumes::see(const scene::Camera& camera, std::optional<int> veilLayers) {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  litLayers_ = veilLayers ? static_cast<std::size_t>(std::max(0, *veilLayers)) : ~std::size_t{0};
  space_ = raster::pixelSpace(camera, surfaces.origin, surfaces.bounds.radius());
  if (auto done = raster::mapPositions(space_, surfaces.positions, positions_); !done) return done;
  if (auto done = surfaces_.draw(space_, positions_, seen_); !done) return done;
  if (auto done = veils_.draw(space_, positions_, seen_, layers_); !done) return done;
  const shadow::CasterSet& casters = geometry_->casters;
  eyeSide_.assign(casters.triangles.size(), 0);
  for (std::uint32_t t = 0; t < eyeSide_.size(); ++t)
    if (geometry_->filters.isVeil(casters.surfaceTriangle[t]))
      eyeSide_[t] = static_cast<std::int8_t>(
          lightSide(casters.corner(t, 0), casters.corner(t, 1), casters.corner(t, 2), Vec4(space_.eye, 1.0)));
  invisible_.clear();
  for (const auto& edgeOn : {surfaces_.edgeOn(), veils_.edgeOn()})
    for (const std::uint32_t t : edgeOn)
      if (casterOf_[t] != shadow::kNoTriangle) invisible_.push_back(casterOf_[t]);
  return {};
}

Result<void> TintedVolumes::findReceivers(FacingMemo& facing) {
  receivers_.assign(layers_.layers.size(), 0);
  return parallel::forEach(layers_.rows, [&](int row) {
    for (std::size_t block = layers_.index(0, row); block < layers_.index(0, row + 1); ++block) {
      const std::size_t begin = layers_.first[block], count = layers_.first[block + 1] - begin;
      for (std::size_t l = 0; l < count; ++l)
        if (l <= litLayers_) receivers_[begin + l] = receiversOf(layers_.layers[begin + l].triangle, facing);
    }
  });
}

/// One light's mask.
class TintedVolumes::Painting {
 public:
  Painting(const TintedVolumes& volumes, const scene::Camera& camera, const scene::Light& light,
           const shadow::VeilBuffer& veils, FacingMemo& facing, shadow::LightMask& mask)
      : volumes_(volumes),
        light_(light),
        veils_(veils),
        facing_(facing),
        mask_(mask),
        rays_(scene::pixelRays(camera)),
        eye_(camera.eye) {
    isSpot_ = std::holds_alternative<scene::SpotLight>(light.shape);
    const Box3& bounds = surfaces().bounds;
    resolution_ = kResolution * largest(glm::max(glm::abs(bounds.min), glm::abs(bounds.max)));
  }

  void paintBlock(int column, int row) {
    const raster::LayeredBlocks& layers = volumes_.layers_;
    const std::size_t block = layers.index(column, row);
    begin_ = layers.first[block], count_ = layers.first[block + 1] - begin_;
    for (int y = kBlock * row; y < std::min(kBlock * (row + 1), mask_.light.height()); ++y)
      for (int x = kBlock * column; x < std::min(kBlock * (column + 1), mask_.light.width()); ++x) paintPixel(x, y);
  }

 private:
  [[nodiscard]] const scene::Surfaces& surfaces() const { return volumes_.geometry_->surfaces; }
  [[nodiscard]] std::uint32_t triangle(std::size_t l, std::size_t pixel) const {
    return volumes_.layers_.layers[begin_ + l].triangle[pixel];
  }

  void paintPixel(int x, int y) {
    const auto pixel = static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock);
    std::size_t depth = 1;  // layers that this pixel has
    while (depth < count_ && triangle(depth, pixel) != shadow::kNoTriangle) ++depth;
    const std::size_t place =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(mask_.light.width()) + static_cast<std::size_t>(x);
    shadow::FilterSum crossed{};  // by the way from the eye, so far
    for (std::size_t l = 1; l < depth; ++l) {
      mask_.veils[veils_.first[place] + l - 1] = veilLight(l, pixel, x, y, crossed);
      cross(l, pixel, crossed);
    }
    mask_.covered(x, y) = triangle(0, pixel) != shadow::kNoTriangle ? 1 : 0;
    mask_.tint(x, y) = lightAt(0, pixel, x, y, without(depth, 0, pixel, x, y, crossed));
    mask_.light(x, y) = codeOf(mask_.tint(x, y));
  }

  [[nodiscard]] Vec3f veilLight(std::size_t l, std::size_t pixel, int x, int y, const shadow::FilterSum& crossed) {
    if (volumes_.litLayers_ == 0)
      return facing_.faces(triangle(l, pixel)) && isInCone(triangle(l, pixel), x, y) ? Vec3f(1.0f) : Vec3f(0.0f);
    if (l > volumes_.litLayers_) return lastVeil_;
    return lastVeil_ = lightAt(l, pixel, x, y, without(l, l, pixel, x, y, crossed));
  }

  /// Adds what a veil takes where the way from the eye passes it: into its shadow, or out of it.
  void cross(std::size_t l, std::size_t pixel, shadow::FilterSum& crossed) const { addVeil(l, pixel, 1, crossed); }

  void addVeil(std::size_t l, std::size_t pixel, int sign, shadow::FilterSum& sum) const {
    const std::uint32_t veil = triangle(l, pixel), caster = volumes_.casterOf_[veil];
    if (caster == shadow::kNoTriangle) return;
    const int side = volumes_.silhouette_.side[caster] * volumes_.eyeSide_[caster];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * side * volumes_.geometry_->filters.of(veil)[k];
  }

  /// What was crossed, less those veils just before layer `own` that lie upon it: surfaces upon each other do not shadow each other. `end`: the layers
  /// before it are those below this number.
  [[nodiscard]] shadow::FilterSum without(std::size_t end, std::size_t own, std::size_t pixel, int x, int y,
                                          shadow::FilterSum crossed) const {
    if (triangle(own, pixel) == shadow::kNoTriangle) return crossed;
    for (std::size_t l = end; l > 1 && liesUpon(l - 1, own, pixel, x, y); --l) addVeil(l - 1, pixel, -1, crossed);
    return crossed;
  }

  [[nodiscard]] bool liesUpon(std::size_t a, std::size_t b, std::size_t pixel, int x, int y) const {
    const auto& layers = volumes_.layers_.layers;
    const float nearA = layers[begin_ + a].nearness[pixel], nearB = layers[begin_ + b].nearness[pixel];
    // Apart beyond doubt, and beyond any slope that matters.
    const double apart = (1.0 / double(nearB) - 1.0 / double(nearA)) / volumes_.space_.scale;
    if (apart > 1024.0 * resolution_) return false;
    const Vec3 ray = rays_.through(x + 0.5, y + 0.5), pixelAt(x + 0.5, y + 0.5, 1.0);
    const auto& mapped = volumes_.positions_.mapped;
    const std::uint32_t first = triangle(a, pixel), second = triangle(b, pixel);
    const double far = 1.0 / raster::nearnessOf(mapped, surfaces().triangles[second], pixelAt),
                 near = 1.0 / raster::nearnessOf(mapped, surfaces().triangles[first], pixelAt);
    const Vec3 normal = glm::normalize(surfaces().normal(first));
    return std::abs((far - near) / volumes_.space_.scale * glm::dot(ray, normal)) <= resolution_;
  }

  [[nodiscard]] Vec3f lightAt(std::size_t l, std::size_t pixel, int x, int y, const shadow::FilterSum& crossed) {
    if ((volumes_.receivers_[begin_ + l] >> pixel & 1u) == 0) return Vec3f(0.0f);
    const raster::TintSum sum = volumes_.results_[begin_ + l].at(pixel);
    if (sum.opaque != 0 || !isInCone(triangle(l, pixel), x, y)) return Vec3f(0.0f);
    shadow::FilterSum taken = sum.filter;
    for (std::size_t k = 0; k < 3; ++k) taken[k] += crossed[k];
    if (taken != lastTaken_) lastTaken_ = taken, lastLight_ = shadow::transmitted(taken);
    return lastLight_;
  }

  [[nodiscard]] std::uint8_t codeOf(const Vec3f& light) {
    if (light != lastCoded_) lastCoded_ = light, lastCode_ = shadow::luminanceCode(light);
    return lastCode_;
  }

  [[nodiscard]] bool isInCone(std::uint32_t t, int x, int y) const {
    if (!isSpot_) return true;
    const Vec3 ray = rays_.through(x + 0.5, y + 0.5), normal = surfaces().normal(t);
    const double depth = glm::dot(normal, surfaces().corner(t, 0) + surfaces().origin - eye_) / glm::dot(normal, ray);
    return scene::insideCone(light_, eye_ + depth * ray);
  }

  const TintedVolumes& volumes_;
  const scene::Light& light_;
  const shadow::VeilBuffer& veils_;
  FacingMemo& facing_;
  shadow::LightMask& mask_;
  scene::PixelRays rays_;
  Vec3 eye_;
  bool isSpot_;
  double resolution_;
  std::size_t begin_ = 0, count_ = 0;  ///< the block's layers
  // Neighbours are mostly alike:
  shadow::FilterSum lastTaken_{};
  Vec3f lastLight_{1.0f}, lastVeil_{0.0f}, lastCoded_{0.0f};
  std::uint8_t lastCode_ = 0;
};

Result<shadow::LightMask> TintedVolumes::mask(const scene::Camera& camera, const scene::Light& light,
                                              const shadow::VeilBuffer& veils, shadow::PhaseClock& clock) {
  const shadow::CasterSet& casters = geometry_->casters;
  const Vec4 homogeneous = scene::homogeneous(light, geometry_->surfaces.origin);
  FacingMemo facing(geometry_->surfaces, Vec4(space_.eye, 1.0), homogeneous);
  if (auto done = findReceivers(facing); !done) return tl::unexpected(done.error());
  clock.end("facing");
  silhouette_ = shadow::findTintedSilhouette(casters, geometry_->filters, homogeneous);
  clock.end("silhouette");
  Box3 room = geometry_->surfaces.bounds;
  room.add(space_.eye);
  const raster::TintSums::Request request{.space = space_,
                                          .positions = positions_,
                                          .seen = layers_,
                                          .triangles = geometry_->surfaces.triangles,
                                          .receivers = receivers_,
                                          .room = room,
                                          .invisible = invisible_,
                                          .silhouette = silhouette_,
                                          .filters = geometry_->filters};
  if (auto done = sums_.find(request, results_); !done) return tl::unexpected(done.error());
  clock.end("volumes");
  const int width = camera.width, height = camera.height;
  shadow::LightMask mask{{width, height}, {width, height}, {width, height}, std::vector<Vec3f>(veils.veils.size())};
  auto done = parallel::forEach(layers_.rows, [&](int row) {
    Painting painting(*this, camera, light, veils, facing, mask);
    for (int column = 0; column < layers_.columns; ++column) painting.paintBlock(column, row);
  });
  if (!done) return tl::unexpected(done.error());
  clock.end("lit");
  return mask;
}

shadow::LightStats TintedVolumes::stats() const {
  const std::size_t edges = silhouette_.edges.size();
  return {.method = "transparent_cpu",
          .reason = "z-pass with what each surface takes instead of a count; " + std::to_string(sums_.atEye().opaque) +
                    " opaque surfaces between the eye and the light",
          .edgesTested = geometry_->casters.edges.size(),
          .silhouetteEdges = edges,
          .volumeTriangles = sums_.sideCount(),
          .eyeCount = sums_.atEye().opaque,
          .finder = "brute_force",
          .sidesBehind = edges - std::min(edges, sums_.sideCount())};
}

}  // namespace umbrage::techniques::detail
