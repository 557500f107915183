#include "umbrage/radiosity/picture.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "umbrage/shadow/barycentric.hpp"
#include "umbrage/shadow/composite.hpp"
#include "umbrage/trace/tiles.hpp"
#include "umbrage/trace/visible_surfaces.hpp"

namespace umbrage::radiosity {
namespace {

constexpr double kTooBright = 0.02;

struct ByPlace {
  bool operator()(const Vec3& a, const Vec3& b) const { return lexicographicallyLess(a, b); }
};

const scene::Material& materialOf(const scene::Scene& scene, const Solution& solution, std::uint32_t vertex) {
  return scene.materials[solution.mesh.sheets()[solution.mesh.vertices()[vertex].sheet].material];
}

/// What a side of a vertex gives off, with what is unshot.
Vec3 shown(const scene::Scene& scene, const Solution& solution, std::uint32_t vertex, std::size_t side) {
  return solution.exitance[vertex][side] + materialOf(scene, solution, vertex).colour * solution.ambient;
}

}  // namespace

Solution smoothed(Solution solution, Angle crease) {
  const Subdivision& mesh = solution.mesh;
  const auto before = solution.exitance;
  std::map<Vec3, std::vector<std::uint32_t>, ByPlace> places;
  for (const Element& element : mesh.elements())
    for (const std::uint32_t v : element.corner) places[mesh.vertices()[v].position].push_back(v);
  const double least = std::cos(crease.radians());
  for (auto& [position, around] : places) {
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const std::uint32_t v : around) {
      const Sheet& own = mesh.sheets()[mesh.vertices()[v].sheet];
      std::array<Vec3, 2> sum{Vec3(0.0), Vec3(0.0)};
      double count = 0.0;
      for (const std::uint32_t w : around) {
        const Sheet& other = mesh.sheets()[mesh.vertices()[w].sheet];
        const double cosine = glm::dot(own.normal, other.normal);
        if (own.material != other.material || std::abs(cosine) < least) continue;
        for (std::size_t s = 0; s < 2; ++s) sum[s] += before[w][cosine > 0.0 ? s : 1 - s];
        ++count;
      }
      for (std::size_t s = 0; s < 2; ++s) solution.exitance[v][s] = sum[s] / count;
    }
  }
  // Middles follow their corners.
  for (const Element& element : mesh.elements()) {
    if (element.children != 0) continue;
    for (std::size_t s = 0; s < 2; ++s)
      for (const std::uint32_t v : element.corner)
        solution.exitance[element.centre][s] =
            glm::max(Vec3(0.0), solution.exitance[element.centre][s] + (solution.exitance[v][s] - before[v][s]) / 3.0);
  }
  return solution;
}

double exposureOf(const scene::Scene& scene, const Solution& solution) {
  std::vector<std::pair<double, double>> bright;  // brightness and area
  double all = 0.0;
  for (const Element& element : solution.mesh.elements()) {
    if (element.children != 0 || materialOf(scene, solution, element.centre).emission != Vec3(0.0)) continue;
    const double area = solution.mesh.area(element);
    for (std::size_t s = 0; s < 2; ++s) {
      const Vec3 light = shown(scene, solution, element.centre, s);
      const double most = std::max({light.x, light.y, light.z});
      if (most > 0.0) bright.emplace_back(most, area), all += area;
    }
  }
  std::sort(bright.rbegin(), bright.rend());
  double passed = 0.0;
  for (const auto& [most, area] : bright)
    if ((passed += area) >= kTooBright * all) return 1.0 / most;
  return 1.0;
}

Result<image::RgbImage> paint(const scene::Scene& scene, const Solution& solution, const scene::Camera& camera,
                              const PictureOptions& options) {
  const auto occlusion = trace::Occlusion::build(solution.surfaces);
  if (!occlusion) return tl::unexpected(occlusion.error());
  const auto seen = trace::visibleSurfaces(*occlusion, camera);
  if (!seen) return tl::unexpected(seen.error());
  const double exposure = options.exposure.value_or(exposureOf(scene, solution));
  const scene::PixelRays rays = scene::pixelRays(camera);
  const Vec3 eye = camera.eye - solution.surfaces->origin;
  const auto code = [](double srgb) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(srgb, 0.0, 1.0)));
  };
  image::RgbImage picture(camera.width, camera.height,
                          {code(options.background.x), code(options.background.y), code(options.background.z)});
  const auto done = trace::forEachTile(camera.width, camera.height, [&](const trace::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::uint32_t triangle = seen->triangle(x, y);
        if (triangle == shadow::kNoTriangle) continue;
        const Vec3 ray = rays.through(x + 0.5, y + 0.5);
        const Vec3 point = eye + double(seen->depth(x, y)) * ray;
        const auto place = solution.mesh.find(triangle, shadow::barycentric(*solution.surfaces, triangle, point));
        if (!place) continue;
        const Sheet& sheet = solution.mesh.sheetOf(solution.mesh.elements()[place->element]);
        const std::size_t side = glm::dot(sheet.normal, ray) < 0.0 ? 0 : 1;
        Vec3 light(0.0);
        for (const Share& share : solution.mesh.between(*place))
          light += share.part * shown(scene, solution, share.vertex, side);
        light *= exposure;
        picture(x, y) = {shadow::encodeSrgb(light.x), shadow::encodeSrgb(light.y), shadow::encodeSrgb(light.z)};
      }
    }
  });
  if (!done) return tl::unexpected(done.error());
  return picture;
}

LitMesh litMesh(const scene::Scene& scene, const Solution& solution) {
  const Subdivision& mesh = solution.mesh;
  std::vector<std::array<bool, 2>> lit(mesh.sheets().size());
  for (std::uint32_t v = 0; v < solution.exitance.size(); ++v)
    for (std::size_t s = 0; s < 2; ++s)
      if (solution.exitance[v][s] != Vec3(0.0)) lit[mesh.vertices()[v].sheet][s] = true;
  for (auto& sides : lit)
    if (!sides[1]) sides[0] = true;
  LitMesh out;
  std::vector<std::array<std::uint32_t, 2>> written(mesh.vertices().size(), {kNone, kNone});
  const auto corner = [&](std::uint32_t vertex, std::size_t side) {
    std::uint32_t& at = written[vertex][side];
    if (at == kNone) {
      at = static_cast<std::uint32_t>(out.positions.size());
      out.positions.push_back(mesh.vertices()[vertex].position + solution.surfaces->origin);
      out.exitance.emplace_back(shown(scene, solution, vertex, side));
    }
    return at;
  };
  for (const Face& face : faces(mesh)) {
    const auto& sides = lit[mesh.vertices()[face.corner[0]].sheet];
    const auto& [a, b, c] = face.corner;
    if (sides[0]) out.triangles.push_back({corner(a, 0), corner(b, 0), corner(c, 0)});
    if (sides[1]) out.triangles.push_back({corner(a, 1), corner(c, 1), corner(b, 1)});
  }
  return out;
}

}  // namespace umbrage::radiosity
