#include "finders/agreement.hpp"

#include <algorithm>
#include <functional>
#include <random>

#include "umbrage/io/load.hpp"
#include "umbrage/shadow/finders/finder.hpp"
#include "umbrage/shadow/finders/many_lights.hpp"
#include "umbrage/shadow/technique.hpp"
#ifdef UMBRAGE_HAVE_RENDER
#include "umbrage/gl/context.hpp"
#include "umbrage/render/gpu_finder.hpp"
#endif

namespace umbrage::finders {
namespace {

std::vector<Vec4> lightsAround(const shadow::CasterSet& casters) {
  std::mt19937 random(1);
  const auto unit = [&] { return double(random() >> 8) * 0x1p-23 - 1.0; };
  const Vec3 centre = casters.bounds.centre();
  const double r = casters.bounds.radius();
  std::vector<Vec4> lights{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, -1, 1, 0}};
  for (int i = 0; i < 4; ++i) {
    const double x = unit(), y = unit(), z = unit();
    const Vec3 d(x, y, z);
    lights.emplace_back(d, 0.0);
    lights.emplace_back(centre + 2.0 * r * d, 1.0);
    lights.emplace_back(centre + 0.5 * casters.bounds.size() * d, 1.0);
    const auto t = static_cast<std::uint32_t>(random() % casters.triangles.size());
    const Vec3 a = casters.corner(t, 0), ab = casters.corner(t, 1) - a, ac = casters.corner(t, 2) - a;
    lights.emplace_back(a, 1.0);
    lights.emplace_back(a + 3.0 * x * ab - 2.0 * y * ac, 1.0);
    lights.emplace_back(x * ab + y * ac, 0.0);
  }
  return lights;
}

std::string compare(const shadow::CasterSet& casters, const shadow::Silhouette& truth,
                    const shadow::FoundEdges& found) {
  for (std::size_t i = 0; i < std::max(truth.edges.size(), found.edges.size()); ++i) {
    const bool both = i < truth.edges.size() && i < found.edges.size();
    const auto same = [&] {
      const shadow::CasterEdge& edge = casters.edges[found.edges[i].edge];
      return edge.a == truth.edges[i].a && edge.b == truth.edges[i].b &&
             found.edges[i].multiplicity == truth.edges[i].multiplicity;
    };
    if (!both || !same()) return "edge " + std::to_string(i) + " of " + std::to_string(truth.edges.size());
  }
  return {};
}

using Note = std::function<void(std::string_view who, std::size_t light, const shadow::FoundEdges& found)>;

// Where there is no graphics there is no such finder.
void askTheGraphicsCard([[maybe_unused]] const std::shared_ptr<const shadow::CasterSet>& casters,
                        [[maybe_unused]] const std::vector<Vec4>& lights,
                        [[maybe_unused]] const shadow::SilhouetteOptions& options, [[maybe_unused]] const Note& note) {
#ifdef UMBRAGE_HAVE_RENDER
  const auto context = gl::Context::createHeadless();
  if (!context) return;
  const gl::CurrentContext current(*context);
  const auto finder = render::GpuFinder::make(casters);
  if (!finder) return;
  // Software renderers take hundreds of milliseconds a million triangles; one light of every kind will do.
  for (std::size_t i = options.countEverySurface ? 1 : 0; i < lights.size(); i += 5)
    note("gpu", i, (*finder)->find(lights[i], options));
#endif
}

}  // namespace

Result<Verdict> judge(const std::filesystem::path& path) {
  const auto scene = io::loadScene(path);
  if (!scene) return tl::unexpected(scene.error());
  const auto geometry = shadow::makeGeometry(*scene);
  if (geometry->casters.triangles.empty()) return fail(ErrorCode::input, "no triangles", path.string());
  const std::shared_ptr<const shadow::CasterSet> casters(geometry, &geometry->casters);
  const std::vector<Vec4> lights = lightsAround(*casters);
  Verdict verdict{casters->triangles.size(), casters->edges.size(), lights.size(), 0, {}};
  for (const bool every : {false, true}) {
    const shadow::SilhouetteOptions options{.countEverySurface = every};
    std::vector<shadow::Silhouette> truth;
    for (const Vec4& light : lights) truth.push_back(shadow::findSilhouette(*casters, light, options));
    const auto note = [&](std::string_view who, std::size_t light, const shadow::FoundEdges& found) {
      const std::string difference = compare(*casters, truth[light], found);
      if (verdict.disagreement.empty() && !difference.empty())
        verdict.disagreement = std::string(who) + ", light " + std::to_string(light) + ": " + difference;
    };
    for (const shadow::FinderKind kind : shadow::finderKinds()) {
      const auto finder = shadow::makeFinder(kind, casters);
      for (std::size_t i = 0; i < lights.size(); ++i) note(shadow::name(kind), i, finder->find(lights[i], options));
    }
    askTheGraphicsCard(casters, lights, options, note);
    const auto many = shadow::ManyLights(casters).find(lights, options);
    for (std::size_t i = 0; i < lights.size(); ++i) note("many lights", i, many[i]);
    for (const shadow::Silhouette& s : truth) verdict.found += s.edges.size();
  }
  return verdict;
}

}  // namespace umbrage::finders
