#include "umbrage/shadow/edge_finder.hpp"

#include <utility>

#include "umbrage/shadow/true_edges.hpp"

namespace umbrage::shadow {
namespace {

constexpr int kSamples = 32;         // a pixel, along each axis
constexpr double kSnap = 0x1p-8;     // pixels
constexpr double kSameDepth = 1e-6;  // relative

}  // namespace

EdgeFinder::EdgeFinder(std::shared_ptr<const Geometry> geometry, std::shared_ptr<Technique> truth)
    : geometry_(std::move(geometry)), truth_(std::move(truth)), contours_(geometry_->surfaces) {}

Result<bool> EdgeFinder::edgeNear(const scene::Camera& camera, const scene::Light& light, int x, int y) const {
  if (const auto shown = samplesShowEdge(camera, light, x, y); !shown || *shown) return shown;
  for (const ContourPoint& point : contours_.near(camera, light, x + 0.5, y + 0.5, kSnap))
    if (const auto seen = sees(camera, light, point); !seen || *seen) return seen;
  return false;
}

Result<bool> EdgeFinder::samplesShowEdge(const scene::Camera& camera, const scene::Light& light, int x, int y) const {
  const scene::Camera fine = magnified(camera, x + 0.5, y + 0.5, kSamples);
  const auto truth = truth_->shade({fine, {&light, 1}});
  if (!truth) return tl::unexpected(truth.error());
  scene::Camera window = fine;
  window.width = window.height = 1;
  const auto edges = trueEdges(geometry_->surfaces, window, fine.width, truth->surface, truth->masks.front());
  return edges(0, 0) != 0;
}

Result<bool> EdgeFinder::sees(const scene::Camera& camera, const scene::Light& light, const ContourPoint& point) const {
  const scene::Camera fine = magnified(camera, point.x, point.y, 1);
  const auto truth = truth_->shade({fine, {&light, 1}});
  if (!truth) return tl::unexpected(truth.error());
  const double depth = glm::dot(point.fromEye, scene::basis(fine).forward);
  return truth->surface.triangle(1, 1) == kNoTriangle || truth->surface.depth(1, 1) >= (1.0 - kSameDepth) * depth;
}

}  // namespace umbrage::shadow
