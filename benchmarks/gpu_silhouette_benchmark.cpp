// Silhouettes by compute shaders beside those of the processor: least and median milliseconds of one query, in turns.
//   umbrage_gpu_silhouette_benchmark [ROUNDS]
// `extrude` finds and writes the volume where it is drawn from, and waits; `find` reads the edges back and sorts them.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include "support/finder_meshes.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/render/gpu_finder.hpp"

namespace umbrage::benchmarks {
namespace {

struct Way {
  const char* name;
  std::function<void(const Vec4& light)> ask;
  std::vector<double> times;
};

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void measure(const char* name, const shadow::test_meshes::Mesh& m, int rounds) {
  const auto casters = std::make_shared<const shadow::CasterSet>(m.casters());
  const auto gpu = render::GpuFinder::make(casters);
  if (!gpu) {
    std::printf("%-8s %8zu triangles: %s\n", name, casters->triangles.size(), gpu.error().text().c_str());
    return;
  }
  const auto scalar = shadow::makeFinder(shadow::FinderKind::bruteForce, casters);
  const auto simd = shadow::makeFinder(shadow::FinderKind::bruteForceSimd, casters);
  const std::vector<render::Role> roles(casters->componentCount, render::Role::fail);
  render::CardVolume volume;
  const auto extrude = [&](const Vec4& light) {
    gl::HostScope scope;
    const render::CardRequest request{
        .light = light, .roles = roles, .sides = render::SideFormat::quad, .farCaps = true};
    if ((*gpu)->fits(request)) (void)(*gpu)->extrude(scope, request, volume);
    gl::finish();
  };
  std::vector<Way> ways{{"brute_force", [&](const Vec4& l) { (void)scalar->silhouette(l); }, {}},
                        {"brute_force_simd", [&](const Vec4& l) { (void)simd->silhouette(l); }, {}},
                        {"gpu, find", [&](const Vec4& l) { (void)(*gpu)->find(l, {}); }, {}},
                        {"gpu, extrude", extrude, {}}};
  const Vec3 centre = casters->bounds.centre();
  for (int round = -1; round < rounds; ++round) {  // shaders compile in the first
    const double turn = 0.7 * round;
    const Vec4 light(centre + 3.0 * casters->bounds.radius() * Vec3(std::cos(turn), std::sin(turn), 0.8), 1.0);
    for (Way& way : ways) {
      const double time = milliseconds([&] { way.ask(light); });
      if (round >= 0) way.times.push_back(time);
    }
  }
  for (Way& way : ways) {
    std::sort(way.times.begin(), way.times.end());
    std::printf("%-8s %8zu triangles  %-18s %9.3f %9.3f ms\n", name, casters->triangles.size(), way.name,
                way.times.front(), way.times[way.times.size() / 2]);
  }
  std::fflush(stdout);
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 9;
  const auto context = gl::Context::createHeadless();
  if (!context) {
    std::printf("cannot run here: %s\n", context.error().text().c_str());
    return 1;
  }
  const gl::CurrentContext current(*context);
  std::printf("%s\n", (*context)->renderer().c_str());
  for (const std::uint32_t triangles : {10'000u, 100'000u, 1'000'000u}) {
    benchmarks::measure("smooth", shadow::test_meshes::smooth(triangles), rounds);
    benchmarks::measure("boxy", shadow::test_meshes::boxy(triangles), rounds);
  }
  return 0;
}
