#include "conformance/judge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/oracle.hpp"
#include "umbrage/shadow/facing.hpp"
#include "umbrage/shadow/true_edges.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
#include "umbrage/techniques/gl/registry.hpp"
#endif

namespace umbrage::conformance {
namespace {

constexpr int kSamples = 32;  ///< a pixel, along each axis
constexpr double kDepthError = 0x1p-15;
constexpr double kSnap = 0x1p-7;            ///< pixels
constexpr std::size_t kMostLookedAt = 256;  ///< a mask with more suspicious pixels than this is simply wrong

double depthOfPlane(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec3& eye, const Vec3& ray) {
  const Vec3 normal = surfaces.normal(triangle);
  return glm::dot(surfaces.corner(triangle, 0) - eye, normal) / glm::dot(ray, normal);
}

std::vector<std::pair<int, int>> farPixels(const shadow::LightMask& mask, const shadow::LightMask& truth,
                                           const image::GreyImage& edges, int tolerance) {
  std::vector<std::pair<int, int>> far;
  const auto edgeNear = [&](int x, int y) {
    for (int v = y - tolerance; v <= y + tolerance; ++v)
      for (int u = x - tolerance; u <= x + tolerance; ++u)
        if (edges.contains(u, v) && edges(u, v) != 0) return true;
    return false;
  };
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x)
      if ((mask.covered(x, y) != truth.covered(x, y) || mask.light(x, y) != truth.light(x, y)) && !edgeNear(x, y))
        far.emplace_back(x, y);
  return far;
}

}  // namespace

std::vector<shadow::TechniqueEntry> allTechniques() {
  auto all = techniques::cpuTechniques();
#ifdef UMBRAGE_HAVE_TECHNIQUES_GL
  for (auto& entry : techniques::openGlTechniques()) all.push_back(std::move(entry));
#endif
  return all;
}

Result<Judge> Judge::make(const shadow::TechniqueEntry& entry, std::shared_ptr<const shadow::Geometry> geometry) {
  Judge judge;
  judge.name_ = entry.traits.name;
  judge.tolerance_ = entry.traits.edgeTolerancePx;
  judge.geometry_ = std::move(geometry);
  auto technique = entry.create();
  auto truth = techniques::cpuTechniques().front().create();
  if (!technique) return tl::unexpected(technique.error());
  if (!truth) return tl::unexpected(truth.error());
  judge.technique_ = std::move(*technique);
  judge.truth_ = std::move(*truth);
  if (auto done = judge.technique_->prepare(judge.geometry_); !done) return tl::unexpected(done.error());
  if (auto done = judge.truth_->prepare(judge.geometry_); !done) return tl::unexpected(done.error());
  return judge;
}

Result<bool> Judge::edgeNear(const Masks& m, int x, int y) const {
  const scene::Camera fine = shadow::magnified(m.camera, x, y, kSamples);
  const auto truth = truth_->shade({fine, {&m.light, 1}});
  if (!truth) return tl::unexpected(truth.error());
  scene::Camera window = fine;
  window.width = window.height = 1;
  const auto edges = shadow::trueEdges(geometry_->surfaces, window, fine.width, truth->surface, truth->masks.front());
  return edges(0, 0) != 0;
}

bool Judge::seesHairline(const Masks& m, const shadow::SurfaceBuffer& truth, int x, int y) const {
  const std::uint32_t triangle = m.seen.triangle(x, y);
  if (triangle == shadow::kNoTriangle || triangle == truth.triangle(x, y)) return false;
  const scene::Surfaces& surfaces = geometry_->surfaces;
  const scene::PixelRays rays = scene::pixelRays(m.camera);
  const double depth = m.seen.depth(x, y), pixel = depth * glm::length(rays.dx);
  const Vec3 point = m.camera.eye - surfaces.origin + depth * rays.through(x + 0.5, y + 0.5);
  const bool gap = truth.triangle(x, y) == shadow::kNoTriangle || truth.depth(x, y) - depth > 2.0 * pixel;
  return gap && distanceToTriangle(point, surfaces.corner(triangle, 0), surfaces.corner(triangle, 1),
                                   surfaces.corner(triangle, 2)) <= pixel;
}

bool Judge::exactForDisplacedPoint(const Masks& m, const shadow::SurfaceBuffer& truth, int x, int y) const {
  const std::uint32_t triangle = m.seen.triangle(x, y);
  const double depth = m.seen.depth(x, y), most = kDepthError * depth;
  if (triangle == shadow::kNoTriangle) return false;
  if (triangle != truth.triangle(x, y) && !(std::abs(depth - truth.depth(x, y)) <= 4.0 * most)) return false;
  const scene::Surfaces& surfaces = geometry_->surfaces;
  const Vec3 eye = m.camera.eye - surfaces.origin;
  const scene::PixelRays rays = scene::pixelRays(m.camera);
  const Vec4 light = scene::homogeneous(m.light, surfaces.origin);
  const bool facing = shadow::visibleSideFacesLight(surfaces, Vec4(eye, 1.0), light)[triangle] != 0;
  const oracle::Oracle bruteForce(surfaces);
  const auto seenThrough = [&](const Vec3& ray) { return eye + depthOfPlane(surfaces, triangle, eye, ray) * ray; };
  const Vec3 centre = seenThrough(rays.through(x + 0.5, y + 0.5));
  const auto agrees = [&](double dx, double dy, double shift) {
    const Vec3 ray = rays.through(x + 0.5 + dx, y + 0.5 + dy), point = seenThrough(ray) + shift * most * ray;
    const auto hidden = bruteForce.hidden(point, scene::towardsLight(light, point), light.w != 0.0, &centre);
    const bool lit = facing && scene::insideCone(m.light, point + surfaces.origin) && hidden == oracle::Answer::no;
    return lit == (m.mask.light(x, y) == 255);
  };
  for (const double dy : {0.0, -kSnap, kSnap})
    for (const double dx : {0.0, -kSnap, kSnap})
      for (const double shift : {0.0, 1.0, -1.0, 0.5, -0.5, 0.25, -0.25})
        if (agrees(dx, dy, shift)) return true;
  return false;
}

Result<std::vector<Verdict>> Judge::judge(const NamedView& view, const std::vector<NamedLight>& named) {
  std::vector<scene::Light> lights;
  for (const NamedLight& n : named) lights.push_back(n.light);
  const auto shading = technique_->shade({view.camera, lights});
  if (!shading) return tl::unexpected(shading.error());
  const auto truth = truth_->shade({view.camera, lights});
  if (!truth) return tl::unexpected(truth.error());
  std::vector<Verdict> verdicts;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const auto edges = shadow::edgePixels(truth->masks[i]);
    Verdict v{name_, "", view.name, named[i].name,
              shadow::compare(shading->masks[i], truth->masks[i], edges, tolerance_)};
    const Masks masks{view.camera, lights[i], shading->surface, shading->masks[i]};
    for (const auto& [x, y] : farPixels(shading->masks[i], truth->masks[i], edges, tolerance_)) {
      if (v.difference.farFromEdge > kMostLookedAt) break;
      const auto edge = edgeNear(masks, x, y);
      if (!edge) return tl::unexpected(edge.error());
      if (*edge || seesHairline(masks, truth->surface, x, y) || exactForDisplacedPoint(masks, truth->surface, x, y))
        --v.difference.farFromEdge;
    }
    verdicts.push_back(std::move(v));
  }
  return verdicts;
}

}  // namespace umbrage::conformance
