#include "umbrage/cut/pieces.hpp"

#include <algorithm>
#include <atomic>
#include <optional>

#include "umbrage/base/check.hpp"
#include "umbrage/cut/light_cutter.hpp"
#include "umbrage/parallel/for_each.hpp"

namespace umbrage::cut {
namespace {

// Faces that one thread takes at a time, and those between two looks at the progress.
constexpr std::size_t kPerTask = 64, kPerRound = 64 * kPerTask;

/// A part of a face on its way through the lights.
struct Part {
  Polygon polygon;
  std::uint64_t litBy = 0;
};

// The parts of `parts` on both sides of every border of one light.
bool cutBy(const FaceCut& cut, std::size_t light, Effort& effort, std::vector<Part>& parts) {
  std::vector<Part> finer;
  bool enough = true;
  for (const Part& part : parts)
    cut.visitPieces(part.polygon, [&](const Polygon& polygon, bool lit) {
      enough = enough && effort.spendPieces(1);
      if (enough) finer.push_back({polygon, part.litBy | (lit ? std::uint64_t{1} << light : 0)});
    });
  parts = std::move(finer);
  return enough;
}

void append(Pieces& to, const Pieces& from) {
  const auto offset = static_cast<std::uint32_t>(to.corners.size());
  to.corners.insert(to.corners.end(), from.corners.begin(), from.corners.end());
  for (const Piece& p : from.pieces) to.pieces.push_back({p.triangle, p.begin + offset, p.end + offset, p.litBy});
}

class SceneCutter {
 public:
  SceneCutter(const std::shared_ptr<const shadow::Geometry>& geometry, std::span<const scene::Light> lights,
              const Effort::Limits& limits)
      : geometry_(geometry), effort_(limits) {
    for (const scene::Light& light : lights) cutters_.emplace_back(geometry, light, ConeSides::lines);
  }

  // The faces from `begin` to `end`, in order.
  Result<Pieces> cut(std::size_t begin, std::size_t end) {
    std::vector<Pieces> tasks((end - begin + kPerTask - 1) / kPerTask);
    const auto done = parallel::forEach(static_cast<int>(tasks.size()), [&](int i) {
      const std::size_t first = begin + static_cast<std::size_t>(i) * kPerTask;
      for (std::size_t t = first; t < std::min(end, first + kPerTask) && !spent_; ++t)
        if (!cutFace(static_cast<std::uint32_t>(t), tasks[static_cast<std::size_t>(i)])) spent_ = true;
    });
    if (!done) return tl::unexpected(done.error());
    if (spent_)
      return fail(ErrorCode::input,
                  "its shadows cross too often: cutting it takes more pieces or time than is allowed");
    Pieces all;
    for (const Pieces& p : tasks) append(all, p);
    return all;
  }

 private:
  bool cutFace(std::uint32_t triangle, Pieces& out) {
    const scene::Surfaces& s = geometry_->surfaces;
    const FaceFrame frame = FaceFrame::of({s.corner(triangle, 0), s.corner(triangle, 1), s.corner(triangle, 2)});
    if (frame.normal == Vec3(0.0)) return true;
    std::vector<Part> parts{{{frame.flatCorners.begin(), frame.flatCorners.end()}}};
    for (std::size_t k = 0; k < cutters_.size(); ++k) {
      const auto cut = cutters_[k].cut(triangle, effort_);
      if (!cut || !cutBy(*cut, k, effort_, parts)) return false;
    }
    for (const Part& part : parts) {
      const auto first = static_cast<std::uint32_t>(out.corners.size());
      for (const Vec2& p : part.polygon) out.corners.push_back(frame.space(p));
      out.pieces.push_back({triangle, first, static_cast<std::uint32_t>(out.corners.size()), part.litBy});
    }
    return true;
  }

  std::shared_ptr<const shadow::Geometry> geometry_;
  std::vector<LightCutter> cutters_;
  Effort effort_;
  std::atomic<bool> spent_ = false;
};

}  // namespace

Result<Pieces> cutSurfaces(const std::shared_ptr<const shadow::Geometry>& geometry,
                           std::span<const scene::Light> lights, const ProgressSink& progress,
                           const std::optional<Effort::Limits>& limits) {
  UMBRAGE_CHECK(lights.size() <= kMostLights, "more lights than a piece has bits");
  const std::size_t count = geometry->surfaces.triangles.size();
  SceneCutter cutter(geometry, lights, limits.value_or(Effort::usual(count)));
  Pieces all;
  for (std::size_t begin = 0; begin < count; begin += kPerRound) {
    if (!reportProgress(progress, double(begin) / double(count), "cutting surfaces"))
      return fail(ErrorCode::cancelled, "cancelled");
    auto some = cutter.cut(begin, std::min(count, begin + kPerRound));
    if (!some) return tl::unexpected(some.error());
    append(all, *some);
  }
  return all;
}

double areaOf(const Pieces& pieces, const Piece& piece) {
  const Vec3 first = pieces.corners[piece.begin];
  Vec3 twice(0.0);
  for (std::uint32_t i = piece.begin + 1; i + 1 < piece.end; ++i)
    twice += glm::cross(pieces.corners[i] - first, pieces.corners[i + 1] - first);
  return 0.5 * glm::length(twice);
}

std::vector<Areas> areasByMaterial(const scene::Surfaces& surfaces, std::size_t materials, const Pieces& pieces,
                                   std::size_t lights) {
  std::vector<Areas> areas(materials);
  for (Areas& a : areas) a.lights.resize(lights);
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    areas[surfaces.materials[t]].surface += 0.5 * glm::length(surfaces.normal(t));
  for (const Piece& piece : pieces.pieces) {
    const double area = areaOf(pieces, piece);
    Areas& a = areas[surfaces.materials[piece.triangle]];
    for (std::size_t k = 0; k < lights; ++k)
      ((piece.litBy >> k & 1u) != 0 ? a.lights[k].lit : a.lights[k].shadowed) += area;
  }
  return areas;
}

Areas sum(std::span<const Areas> areas) {
  Areas all;
  for (const Areas& a : areas) {
    all.surface += a.surface;
    all.lights.resize(std::max(all.lights.size(), a.lights.size()));
    for (std::size_t k = 0; k < a.lights.size(); ++k) {
      all.lights[k].lit += a.lights[k].lit;
      all.lights[k].shadowed += a.lights[k].shadowed;
    }
  }
  return all;
}

}  // namespace umbrage::cut
