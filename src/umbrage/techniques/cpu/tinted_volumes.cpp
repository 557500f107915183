#include "umbrage/techniques/cpu/detail/tinted_volumes.hpp"

#include <algorithm>
#include <string>
#include <variant>

#include "umbrage/math/predicates.hpp"
#include "umbrage/shadow/veil_layers.hpp"
#include "umbrage/trace/occlusion.hpp"

namespace umbrage::techniques::detail {
using raster::kBlock;

TintedVolumes::TintedVolumes(std::shared_ptr<const shadow::Geometry> geometry)
    : geometry_(std::move(geometry)),
      casterOf_(geometry_->surfaces.triangles.size(), shadow::kNoTriangle),
      surfaces_(*geometry_, raster::Drawn::opaque),
      veils_(*geometry_),
      sums_(geometry_->casters) {
  const std::vector<std::uint32_t>& origin = geometry_->casters.surfaceTriangle;
  for (std::uint32_t t = 0; t < origin.size(); ++t) casterOf_[origin[t]] = t;
}

Result<void> TintedVolumes::see(const scene::Camera& camera, std::optional<int> veilLayers, shadow::VeilBuffer& veils) {
  const scene::Surfaces& surfaces = geometry_->surfaces;
  space_ = raster::pixelSpace(camera, surfaces);
  if (auto done = raster::mapPositions(space_, surfaces.positions, positions_); !done) return done;
  if (auto done = surfaces_.draw(space_, positions_, seen_); !done) return done;
  if (auto done = veils_.draw(space_, positions_, seen_, veils); !done) return done;
  litLayers_ = shadow::litVeilLayers(veilLayers, veils, geometry_->filters);
  if (auto done = raster::layersOf(space_, veils, litLayers_, layers_); !done) return done;
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
  receivers_.assign(layers_.surfaceCount(), 0);
  return parallel::forEach(layers_.rows, [&](int row) {
    for (std::size_t block = layers_.index(0, row); block < layers_.index(0, row + 1); ++block) {
      const std::size_t surface = layers_.surface(block), lit = std::min(layers_.count(block), litLayers_);
      receivers_[surface] = receiversOf(seen_.triangle.blocks[block].pixel, facing);
      for (std::size_t l = 0; l < lit; ++l)
        receivers_[surface + 1 + l] = receiversOf(layers_.layers[layers_.first[block] + l].triangle, facing);
    }
  });
}

/// One light's mask, block by block.
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
        eye_(camera.eye),
        isSpot_(std::holds_alternative<scene::SpotLight>(light.shape)) {
    const Box3& bounds = surfaces().bounds;
    resolution_ = trace::resolution(trace::largest(glm::max(glm::abs(bounds.min), glm::abs(bounds.max))));
  }

  void paintBlock(int column, int row) {
    const raster::VeilLayers& layers = volumes_.layers_;
    block_ = layers.index(column, row), surface_ = layers.surface(block_);
    const int begin = kBlock * column, end = std::min(kBlock * (column + 1), mask_.light.width());
    for (int y = kBlock * row; y < std::min(kBlock * (row + 1), mask_.light.height()); ++y) {
      if (!isSpot_ && !hasVeils(begin, end, y))
        paintPlainRow(begin, end, y);
      else
        for (int x = begin; x < end; ++x)
          paintPixel({x, y, static_cast<std::size_t>(y % kBlock * kBlock + x % kBlock)});
    }
  }

 private:
  struct Pixel {
    int x, y;           ///< of the picture
    std::size_t local;  ///< of the block
  };
  [[nodiscard]] const scene::Surfaces& surfaces() const { return volumes_.geometry_->surfaces; }
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(mask_.light.width()) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool hasVeils(int begin, int end, int y) const {
    return !veils_.empty() && veils_.first[place(begin, y)] != veils_.first[place(end, y)];
  }
  // A row of the block before which there are no veils.
  void paintPlainRow(int begin, int end, int y) {
    const auto first = static_cast<std::size_t>(y % kBlock * kBlock);
    const std::uint64_t receivers = volumes_.receivers_[surface_] >> first;
    const auto& triangles = volumes_.seen_.triangle.blocks[block_].pixel;
    const bool isWhole = volumes_.field_.isWhole(surface_);
    shadow::Tint lit = isWhole ? passing(volumes_.field_.whole[block_]) : shadow::Tint{};
    const auto count = static_cast<std::size_t>(end - begin);
    const std::uint64_t all = (std::uint64_t{1} << count) - 1;
    const bool none = (receivers & all) == 0;
    if (none || (isWhole && (receivers & all) == all)) {
      const shadow::Tint tint = none ? shadow::Tint{} : lit;
      std::fill_n(mask_.tint.row(y) + begin, count, tint);
      std::fill_n(mask_.light.row(y) + begin, count, codeOf(tint));
      for (std::size_t k = 0; k < count; ++k)
        mask_.covered.row(y)[static_cast<std::size_t>(begin) + k] = triangles[first + k] != shadow::kNoTriangle ? 1 : 0;
      return;
    }
    for (int x = begin; x < end; ++x) {
      const auto k = static_cast<std::size_t>(x - begin);
      const bool faces = (receivers >> k & 1u) != 0;
      if (!isWhole && faces) lit = passing(volumes_.field_.at(block_, surface_, first + k));
      const shadow::Tint tint = faces ? lit : shadow::Tint{};
      mask_.tint(x, y) = tint;
      mask_.light(x, y) = codeOf(tint);
      mask_.covered(x, y) = triangles[first + k] != shadow::kNoTriangle ? 1 : 0;
    }
  }

  [[nodiscard]] shadow::Tint passing(const raster::TintSum& sum) {
    return sum.opaque == 0 ? remaining(sum.filter) : shadow::Tint{};
  }

  void paintPixel(const Pixel& p) {
    const std::size_t at = place(p.x, p.y);
    const std::span<const shadow::Veil> before = veils_.at(at);
    shadow::FilterSum crossed{};  // by the way from the eye, so far
    shadow::Tint last{};
    for (std::size_t k = 0; k < before.size(); ++k) {
      last = mask_.veils[veils_.first[at] + k] = veilLight(before, k, p, crossed, last);
      add(volumes_.crossing_[before[k].triangle], 1, crossed);
    }
    const std::uint32_t opaque = volumes_.seen_.triangle.blocks[block_].pixel[p.local];
    mask_.covered(p.x, p.y) = opaque != shadow::kNoTriangle ? 1 : 0;
    const bool faces = (volumes_.receivers_[surface_] >> p.local & 1u) != 0;
    const float depth =
        1.0f / (volumes_.seen_.nearness.blocks[block_].pixel[p.local] * static_cast<float>(volumes_.space_.scale));
    const shadow::Tint tint = faces ? lightAt({opaque, depth}, surface_, before, p, crossed) : shadow::Tint{};
    mask_.tint(p.x, p.y) = tint;
    mask_.light(p.x, p.y) = codeOf(tint);
  }

  /// `last`: of the veil before.
  [[nodiscard]] shadow::Tint veilLight(std::span<const shadow::Veil> veils, std::size_t k, const Pixel& p,
                                       const shadow::FilterSum& crossed, const shadow::Tint& last) {
    if (volumes_.litLayers_ == 0)
      return mayFace(veils[k].triangle) && facing_.faces(veils[k].triangle) && isInCone(veils[k].triangle, p)
                 ? shadow::kFullTint
                 : shadow::Tint{};
    if (k >= volumes_.litLayers_) return last;
    const std::size_t surface = surface_ + 1 + k;
    if ((volumes_.receivers_[surface] >> p.local & 1u) == 0) return {};
    return lightAt(veils[k], surface, veils.first(k), p, crossed);
  }

  /// False where a veil surely does not face the light: the signs are there anyway.
  [[nodiscard]] bool mayFace(std::uint32_t veil) const {
    const std::uint32_t caster = volumes_.casterOf_[veil];
    return caster == shadow::kNoTriangle || volumes_.silhouette_.side[caster] * volumes_.eyeSide_[caster] > 0;
  }

  static void add(const shadow::FilterSum& filter, int sign, shadow::FilterSum& sum) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += sign * filter[k];
  }

  /// What reaches a surface that faces the light. `crossed`: by the way from the eye, of the veils `before` it.
  [[nodiscard]] shadow::Tint lightAt(const shadow::Veil& seen, std::size_t surface,
                                     std::span<const shadow::Veil> before, const Pixel& p, shadow::FilterSum crossed) {
    const raster::TintSum sum = volumes_.field_.at(block_, surface, p.local);
    if (sum.opaque != 0 || !isInCone(seen.triangle, p)) return {};
    // Surfaces upon each other do not shadow each other.
    for (std::size_t k = before.size(); k > 0 && liesUpon(before[k - 1], seen, p); --k)
      add(volumes_.crossing_[before[k - 1].triangle], -1, crossed);
    add(sum.filter, 1, crossed);
    return remaining(crossed);
  }

  [[nodiscard]] bool liesUpon(const shadow::Veil& a, const shadow::Veil& b, const Pixel& p) const {
    // Apart beyond doubt, and beyond any slope that matters.
    if (double(b.depth) - double(a.depth) > 64.0 * resolution_) return false;
    const Vec3 ray = rays_.through(p.x + 0.5, p.y + 0.5), pixel(p.x + 0.5, p.y + 0.5, 1.0);
    const auto depth = [&](std::uint32_t t) {
      return 1.0 /
             (volumes_.space_.scale * raster::nearnessOf(volumes_.positions_.mapped, surfaces().triangles[t], pixel));
    };
    const Vec3 normal = glm::normalize(surfaces().normal(a.triangle));
    return std::abs((depth(b.triangle) - depth(a.triangle)) * glm::dot(ray, normal)) <= resolution_;
  }

  [[nodiscard]] shadow::Tint remaining(const shadow::FilterSum& taken) {
    const auto mixed = (static_cast<std::uint32_t>(taken[0]) * 3u + static_cast<std::uint32_t>(taken[1]) * 5u +
                        static_cast<std::uint32_t>(taken[2]) * 7u) *
                       0x9E3779B1u;
    Known& known = known_[mixed >> 26];
    if (known.taken != taken) known = {taken, shadow::tintOf(volumes_.geometry_->filters.transmitted(taken))};
    return known.tint;
  }

  [[nodiscard]] std::uint8_t codeOf(const shadow::Tint& tint) {
    if (tint != lastCoded_) lastCoded_ = tint, lastCode_ = shadow::luminanceCode(tint);
    return lastCode_;
  }

  [[nodiscard]] bool isInCone(std::uint32_t t, const Pixel& p) const {
    if (!isSpot_) return true;
    const Vec3 ray = rays_.through(p.x + 0.5, p.y + 0.5), normal = surfaces().normal(t);
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
  std::size_t block_ = 0, surface_ = 0;  ///< where the work is; its opaque surface
  // Sums are mostly few, and neighbours alike:
  struct Known {
    shadow::FilterSum taken{};
    shadow::Tint tint = shadow::kFullTint;
  };
  std::array<Known, 64> known_;
  shadow::Tint lastCoded_{};
  std::uint8_t lastCode_ = 0;
};

// What the way from the eye takes up where it passes a veil: into its shadow when eye and light are on one side of it, else out of it.
void TintedVolumes::findCrossings() {
  const shadow::CasterSet& casters = geometry_->casters;
  crossing_.resize(geometry_->surfaces.triangles.size());
  for (std::uint32_t t = 0; t < casters.triangles.size(); ++t) {
    const std::uint32_t surface = casters.surfaceTriangle[t];
    const int sign = silhouette_.side[t] * eyeSide_[t];
    for (std::size_t k = 0; k < 3 && eyeSide_[t] != 0; ++k)
      crossing_[surface][k] = sign * geometry_->filters.of(surface)[k];
  }
}

Result<shadow::LightMask> TintedVolumes::mask(const scene::Camera& camera, const scene::Light& light,
                                              const shadow::VeilBuffer& veils, shadow::PhaseClock& clock) {
  const shadow::CasterSet& casters = geometry_->casters;
  const Vec4 homogeneous = scene::homogeneous(light, geometry_->surfaces.origin);
  FacingMemo facing(geometry_->surfaces, Vec4(space_.eye, 1.0), homogeneous);
  if (auto done = findReceivers(facing); !done) return tl::unexpected(done.error());
  clock.end("facing");
  silhouette_ = shadow::findTintedSilhouette(casters, geometry_->filters, homogeneous);
  findCrossings();
  clock.end("silhouette");
  Box3 room = geometry_->surfaces.bounds;
  room.add(space_.eye);
  const raster::TintSums::Request request{.space = space_,
                                          .positions = positions_,
                                          .seen = seen_,
                                          .veils = layers_,
                                          .triangles = geometry_->surfaces.triangles,
                                          .receivers = receivers_,
                                          .room = room,
                                          .invisible = invisible_,
                                          .silhouette = silhouette_,
                                          .filters = geometry_->filters};
  if (auto done = sums_.find(request, field_); !done) return tl::unexpected(done.error());
  clock.end("volumes");
  const int width = camera.width, height = camera.height;
  shadow::LightMask mask{image::GreyImage::unset(width, height), image::Image<shadow::Tint>::unset(width, height),
                         image::GreyImage::unset(width, height), image::UnsetVector<shadow::Tint>(veils.veils.size())};
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
