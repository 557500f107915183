// Prints the pixels in which techniques differ from the truth: inspect SCENE VIEW LIGHT [plain].
#include <cstdio>
#include <cstring>

#include "conformance/judge.hpp"
#ifdef UMBRAGE_HAVE_IO
#include "conformance/models.hpp"
#endif
#include "support/oracle.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

using namespace umbrage;

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  const auto fill = argc == 5 ? shadow::VolumeFill::plain : shadow::VolumeFill::reduced;
  auto c = conformance::Case();
#ifdef UMBRAGE_HAVE_IO
  if (std::strchr(argv[1], '.') != nullptr) c = conformance::modelCase(argv[1]).value();
#endif
  if (c.name.empty()) c = conformance::makeCase(argv[1]);
  const auto geometry = shadow::makeGeometry(c.scene);
  for (auto& view : conformance::searchViews(c, *geometry, 1000)) c.views.push_back(std::move(view));
  const oracle::Oracle bruteForce(geometry->surfaces);
  for (const auto& entry : conformance::allTechniques()) {
    auto truth = conformance::allTechniques().front().create();
    auto technique = entry.create();
    if (!technique || !(*technique)->prepare(geometry) || !(*truth)->prepare(geometry)) continue;
    for (const auto& view : c.views) {
      if (view.name != argv[2]) continue;
      for (const auto& light : c.lights) {
        if (light.name != argv[3]) continue;
        const auto a = (*technique)->shade({.camera = view.camera, .lights = {&light.light, 1}, .fill = fill});
        const auto b = (*truth)->shade({view.camera, {&light.light, 1}});
        const Vec4 l = scene::homogeneous(light.light, geometry->surfaces.origin);
        std::printf("%s: eye %.9g %.9g %.9g light %.9g %.9g %.9g %g\n", entry.traits.name.c_str(), view.camera.eye.x,
                    view.camera.eye.y, view.camera.eye.z, l.x, l.y, l.z, l.w);
        int shown = 0;
        for (int y = 0; y < view.camera.height; ++y)
          for (int x = 0; x < view.camera.width; ++x) {
            const auto &m = a->masks[0], &t = b->masks[0];
            if (m.light(x, y) == t.light(x, y) && m.covered(x, y) == t.covered(x, y)) continue;
            if (++shown > 20) continue;
            const auto p = bruteForce.look(view.camera, light.light, x + 0.5, y + 0.5);
            std::printf(
                "  %d %d: %d/%d tri %d depth %.6g; truth %d/%d tri %d depth %.6g; brute force %d/%d%s point %.9g %.9g "
                "%.9g\n",
                x, y, m.light(x, y), m.covered(x, y), int(a->surface.triangle(x, y)), a->surface.depth(x, y),
                t.light(x, y), t.covered(x, y), int(b->surface.triangle(x, y)), b->surface.depth(x, y), p.lit,
                p.covered, p.clear ? "" : " unclear", p.point.x, p.point.y, p.point.z);
          }
        std::printf("  %d pixels; %s\n", shown, a->stats.lights.empty() ? "" : a->stats.lights[0].reason.c_str());
      }
    }
  }
}
