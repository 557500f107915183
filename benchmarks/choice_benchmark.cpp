// Which technique is the fastest where: times of the techniques that need no GPU, on the benchmark's views, on soups and fine meshes, and on every
// model below folders; whole frames of 1280 x 720, the least of ROUNDS, taking turns. And what the one that `auto` takes costs against the best other.
//   umbrage_choice_benchmark [ROUNDS [FOLDER ..]]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "conformance/models.hpp"
#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#include "views.hpp"

namespace umbrage::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWarm = 8;  ///< frames before the clock counts: enough for what is bought only when it pays
constexpr const char* kChosen = "hybrid_cpu";  // by `auto` where there is no GPU
double worst = 0.0;

bool measure(const View& view, int rounds) {
  std::vector<std::unique_ptr<shadow::Technique>> techniques;
  std::vector<double> least;
  const auto entries = techniques::cpuTechniques();
  for (const auto& entry : entries) {
    auto technique = entry.create();
    if (!technique || !(*technique)->prepare(view.geometry)) return false;
    techniques.push_back(std::move(*technique));
    least.push_back(1e30);
  }
  const shadow::Frame frame{view.camera, {&view.light, 1}};
  shadow::LightStats stats;
  for (int round = -kWarm; round < rounds; ++round)
    for (std::size_t i = 0; i < techniques.size(); ++i) {
      const auto start = Clock::now();
      const auto shading = techniques[i]->shade(frame);
      if (!shading) return false;
      if (round >= 0)
        least[i] = std::min(least[i], std::chrono::duration<double, std::milli>(Clock::now() - start).count());
      if (entries[i].traits.name == "zpass_cpu") stats = shading->stats.lights.front();
    }
  double best = 1e30;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].traits.name != kChosen) best = std::min(best, least[i]);
  double taken = best;
  std::printf("%-34s %8zu triangles %8zu edges %8zu sides", view.name.substr(0, 34).c_str(),
              view.geometry->surfaces.triangles.size(), stats.silhouetteEdges, stats.volumeTriangles);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::printf("  %s %7.2f", entries[i].traits.name.c_str(), least[i]);
    if (entries[i].traits.name == kChosen) taken = least[i];
  }
  std::printf("  auto/best %.2f\n", taken / best);
  std::fflush(stdout);
  worst = std::max(worst, taken / best);
  return true;
}

std::vector<View> fixedViews() {
  std::vector<View> views{fromTheAir(), fromTheStreet(), knot(),           cityAir(),
                          cityStreet(), cityLamp(),      groovedKnotView()};
  for (const int count : {1000, 10000, 100000, 1000000})
    for (const double size : {0.02, 0.2}) {
      const auto corner = [size, centre = Vec3(0.0), left = 0](shapes::Random& r) mutable {
        if (left == 0) centre = Vec3(r.in(-1, 1), r.in(-1, 1), r.in(-1, 1)), left = 3;
        --left;
        return centre + size * Vec3(r.in(-1, 1), r.in(-1, 1), r.in(-1, 1));
      };
      const auto scene = shapes::scene(
          {shapes::soup(1, count, corner), shapes::quad({-9, -9, -1}, {9, -9, -1}, {9, 9, -1}, {-9, 9, -1})});
      View view{
          "soup_" + std::to_string(count) + (size > 0.1 ? "_large" : "_small"), shadow::makeGeometry(scene), {}, {}};
      view.camera = scene::frameAll({Vec3(-1.0), Vec3(1.0)}, scene::UpAxis::z, {}, Angle::degrees(45), 1280, 720);
      view.light.shape = scene::DirectionalLight{{-0.4, -0.5, -0.8}};
      views.push_back(std::move(view));
    }
  for (const int columns : {300, 1000}) {
    View view{"fine_knot_" + std::to_string(columns),
              shadow::makeGeometry(shapes::scene({shapes::knot(Vec3(0.0), 1.0, 0.3, columns, columns / 2)})),
              {},
              {}};
    view.camera = scene::frameAll({Vec3(-1.2), Vec3(1.2)}, scene::UpAxis::z, {}, Angle::degrees(45), 1280, 720);
    view.light.shape = scene::PointLight{{3, 2, 4}};
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage;
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  for (const benchmarks::View& view : benchmarks::fixedViews())
    if (!benchmarks::measure(view, rounds)) return EXIT_FAILURE;
  for (int i = 2; i < argc; ++i)
    for (const auto& path : conformance::modelFiles(argv[i])) {
      const auto model = conformance::modelCase(path);
      if (!model) continue;
      scene::Camera camera = model->views.front().camera;
      camera.width = 1280, camera.height = 720;
      const auto geometry = shadow::makeGeometry(model->scene);
      if (!benchmarks::measure({path.filename().string(), geometry, camera, model->lights.front().light}, rounds))
        return EXIT_FAILURE;
    }
  std::printf("the worst choice takes %.2f of the best\n", benchmarks::worst);
}
