// Shadows as polygons: a courtyard's surfaces are cut along the borders of its shadows, and the cuts are drawn over the picture.
//   cut_shadows [OUT.png]
#include <umbrage/cut/pieces.hpp>
#include <umbrage/png/png.hpp>
#include <umbrage/samples/samples.hpp>
#include <umbrage/shadow/composite.hpp>
#include <umbrage/techniques/cpu/registry.hpp>

#include <algorithm>
#include <cstdio>
#include <string_view>

using namespace umbrage;

// The piece of a triangle that a point of it lies in. Pieces stand in the order of their triangles.
std::size_t pieceAt(const shadow::Geometry& geometry, const cut::Pieces& cut, std::uint32_t triangle, const Vec3& p) {
  const Vec3 normal = geometry.surfaces.normal(triangle);
  auto piece = std::ranges::lower_bound(cut.pieces, triangle, {}, &cut::Piece::triangle);
  std::size_t best = 0;
  double inmost = -1e300;  // a point on a border may be outside of both by rounding
  for (; piece != cut.pieces.end() && piece->triangle == triangle; ++piece) {
    double inside = 1e300;
    for (auto i = piece->begin; i < piece->end; ++i) {
      const Vec3 a = cut.corners[i], b = cut.corners[i + 1 < piece->end ? i + 1 : piece->begin];
      inside = std::min(inside, glm::dot(glm::cross(normal, b - a), p - a) / glm::length(b - a));
    }
    if (inside > inmost) inmost = inside, best = static_cast<std::size_t>(piece - cut.pieces.begin());
  }
  return best;
}

// Which piece each pixel shows; none of them where nothing is seen.
image::Image<std::size_t> piecesSeen(const shadow::Geometry& geometry, const cut::Pieces& cut,
                                     const scene::Camera& camera, const shadow::SurfaceBuffer& seen) {
  image::Image<std::size_t> pieces(camera.width, camera.height, cut.pieces.size());
  const scene::PixelRays rays = scene::pixelRays(camera);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      const std::uint32_t t = seen.triangle(x, y);
      if (t == shadow::kNoTriangle) continue;
      const Vec3 p = camera.eye + double(seen.depth(x, y)) * rays.through(x + 0.5, y + 0.5);
      pieces(x, y) = pieceAt(geometry, cut, t, p - geometry.surfaces.origin);
    }
  return pieces;
}

// Cuts are dark lines in the light and bright ones in shadow; edges of triangles are faint.
void drawCuts(const cut::Pieces& cut, const image::Image<std::size_t>& pieces, image::RgbImage& picture) {
  for (int y = 0; y + 1 < picture.height(); ++y)
    for (int x = 0; x + 1 < picture.width(); ++x) {
      const std::size_t piece = pieces(x, y), right = pieces(x + 1, y), below = pieces(x, y + 1);
      if (piece == cut.pieces.size() || (piece == right && piece == below)) continue;
      const auto isCut = [&](std::size_t other) {
        return other != piece && other < cut.pieces.size() && cut.pieces[other].triangle == cut.pieces[piece].triangle;
      };
      const double line = cut.pieces[piece].litBy != 0 ? 0.0 : 255.0;
      const double strength = isCut(right) || isCut(below) ? 0.7 : 0.15;
      const auto towards = [&](std::uint8_t v) { return static_cast<std::uint8_t>(v + strength * (line - v)); };
      image::Rgb8& pixel = picture(x, y);
      pixel = {towards(pixel.r), towards(pixel.g), towards(pixel.b)};
    }
}

Result<void> draw(const char* path) {
  auto made = samples::make("courtyard");
  if (!made) return tl::unexpected(made.error());
  const scene::Scene scene = scene::withGround(std::move(*made));
  const scene::Camera camera{
      .eye = {-30, -46, 72}, .target = {-3, 3, 5}, .fovY = Angle::degrees(36), .width = 960, .height = 540};
  const std::vector<scene::Light> lights{{.shape = scene::DirectionalLight{{-0.3, 1, -1.1}}}};
  const auto geometry = shadow::makeGeometry(scene);

  const auto cut = cut::cutSurfaces(geometry, lights);
  if (!cut) return tl::unexpected(cut.error());
  const auto areas = cut::sum(cut::areasByMaterial(geometry->surfaces, scene.materials.size(), *cut, lights.size()));
  std::printf("%zu triangles in %zu pieces; %.6f m2 lit + %.6f m2 in shadow = %.6f m2\n",
              geometry->surfaces.triangles.size(), cut->pieces.size(), areas.lights[0].lit, areas.lights[0].shadowed,
              areas.surface);

  // The technique of that name makes the same cuts for what a camera sees.
  auto entries = techniques::cpuTechniques();
  const auto svbsp = std::ranges::find_if(entries, [](const auto& e) { return e.traits.name == "svbsp"; });
  auto technique = svbsp->create();
  if (!technique) return tl::unexpected(technique.error());
  if (const auto ready = (*technique)->prepare(geometry); !ready) return ready;
  const auto shading = (*technique)->shade({camera, lights});
  if (!shading) return tl::unexpected(shading.error());
  auto picture = shadow::composite(scene, geometry->surfaces, camera, shading->surface, lights, shading->masks);
  drawCuts(*cut, piecesSeen(*geometry, *cut, camera, shading->surface), picture);
  return png::write(path, picture);
}

int main(int count, char** words) {
  const char* path = count > 1 ? words[1] : "cut_shadows.png";
  if (const auto done = draw(path); !done) {
    std::fprintf(stderr, "error: %s\n", done.error().text().c_str());
    return exitCode(done.error().code);
  }
  std::puts(path);
}
