// The phases of a frame, for every technique that runs here: medians over the rounds, in milliseconds.
#include <benchmark/benchmark.h>

#include <map>

#include "all_techniques.hpp"
#include "median.hpp"
#include "views.hpp"

namespace umbrage::benchmarks {
namespace {

void frame(benchmark::State& state, const shadow::TechniqueEntry& entry, View (*make)()) {
  const View view = make();
  auto technique = entry.create();
  if (!technique) return state.SkipWithError(technique.error().text().c_str());
  if (auto done = (*technique)->prepare(view.geometry); !done) return state.SkipWithError(done.error().text().c_str());
  const shadow::Frame f{view.camera, {&view.light, 1}};
  for (int i = 0; i < 2; ++i) (void)(*technique)->shade(f);  // shaders compile in the first frames
  std::map<std::string, std::vector<double>> phases;
  for (auto _ : state) {
    const auto shading = (*technique)->shade(f);
    if (!shading) return state.SkipWithError(shading.error().text().c_str());
    for (const shadow::PhaseTime& phase : shading->stats.phases) phases[phase.name].push_back(phase.milliseconds);
  }
  for (auto& [name, times] : phases) state.counters[name + "_ms"] = median(times);
  state.counters["triangles"] = double(view.geometry->surfaces.triangles.size());
}

// Once per geometry: welding and edges, then the technique's own preparation.
void prepare(benchmark::State& state, const shadow::TechniqueEntry& entry, View (*make)()) {
  const View view = make();
  for (auto _ : state) {
    auto technique = entry.create();
    if (!technique || !(*technique)->prepare(view.geometry)) return state.SkipWithError("cannot run here");
  }
}

const bool kRegistered = [] {
  const std::pair<const char*, View (*)()> views[] = {{"building_air", fromTheAir},
                                                      {"building_street", fromTheStreet},
                                                      {"knot", knot},
                                                      {"city_air", cityAir},
                                                      {"city_street", cityStreet},
                                                      {"city_lamp", cityLamp},
                                                      {"grooved_knot", groovedKnotView}};
  for (const auto& entry : allTechniques()) {
    for (const auto& [name, make] : views) {
      const auto run = [entry, make = make](benchmark::State& state) { frame(state, entry, make); };
      benchmark::RegisterBenchmark(("frame/" + entry.traits.name + "/" + name).c_str(), run)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->Iterations(9);
    }
    const auto run = [entry](benchmark::State& state) { prepare(state, entry, fromTheAir); };
    benchmark::RegisterBenchmark(("prepare/" + entry.traits.name + "/building").c_str(), run)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->Iterations(5);
  }
  return true;
}();

}  // namespace
}  // namespace umbrage::benchmarks
