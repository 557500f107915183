// ray_traced's shadow phase against bare Embree packets from the same depth buffer: paired rounds in one run.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>

#include "bare_rays.hpp"
#include "median.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

double shadowMilliseconds(const shadow::Shading& shading) {
  for (const shadow::PhaseTime& phase : shading.stats.phases)
    if (phase.name == "shadow") return phase.milliseconds;
  return 0.0;
}

// Arguments: threads.
void shadowRays(benchmark::State& state, View (*make)()) {
  const View view = make();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  auto technique = techniques::cpuTechniques().front().create();
  if (!technique || !(*technique)->prepare(view.geometry)) return state.SkipWithError("ray_traced cannot run here");
  const BareRays bare(view);
  const shadow::Frame frame{view.camera, {&view.light, 1}};
  auto shading = (*technique)->shade(frame);
  if (!shading) return state.SkipWithError("ray_traced failed");
  (void)bare.mask(shading->surface);  // warm

  std::vector<double> traced, plain, ratio;
  std::size_t differing = 0;
  for (auto _ : state) {
    shading = (*technique)->shade(frame);
    const auto start = Clock::now();
    const image::GreyImage mask = bare.mask(shading->surface);
    plain.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    traced.push_back(shadowMilliseconds(*shading));
    ratio.push_back(traced.back() / plain.back());
    state.SetIterationTime(traced.back() / 1000.0);
    differing = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) differing += mask.pixels()[i] != shading->masks[0].light.pixels()[i];
  }
  state.counters["traced_ms"] = median(traced);
  state.counters["bare_ms"] = median(plain);
  state.counters["ratio"] = median(ratio);
  state.counters["lit_pixels"] =
      double(std::count(shading->masks[0].light.pixels().begin(), shading->masks[0].light.pixels().end(), 255));
  state.counters["differing_pixels"] = double(differing);
}

#define UMBRAGE_SHADOW_RAYS(view)           \
  BENCHMARK_CAPTURE(shadowRays, view, view) \
      ->Arg(1)                              \
      ->Arg(2)                              \
      ->UseManualTime()                     \
      ->Unit(benchmark::kMillisecond)       \
      ->Iterations(31)
UMBRAGE_SHADOW_RAYS(fromTheAir);
UMBRAGE_SHADOW_RAYS(fromTheStreet);
UMBRAGE_SHADOW_RAYS(knot);
UMBRAGE_SHADOW_RAYS(cityAir);
UMBRAGE_SHADOW_RAYS(cityStreet);
UMBRAGE_SHADOW_RAYS(cityLamp);
UMBRAGE_SHADOW_RAYS(groovedKnotView);

}  // namespace
}  // namespace umbrage::benchmarks
