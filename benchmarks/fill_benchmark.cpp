// What each way to draw less of the shadow volumes gains, against the plain volumes and bare shadow rays: paired rounds in one run.
//   umbrage_fill_benchmark [ROUNDS [VIEW [WORD]]]     WORD: only ways with it in their names, beside the first
// A line gives, over the rounds: the volumes' phase (least and median, in milliseconds, and the median ratio to plain zfail in the same round), the
// work on the processor for it, and the whole shading of the light without the surfaces (least, and the median ratio to bare rays).
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string_view>

#include "bare_rays.hpp"
#include "umbrage/techniques/cpu/registry.hpp"
#include "umbrage/techniques/gl/zfail.hpp"
#include "umbrage/techniques/gl/zpass.hpp"

namespace umbrage::benchmarks {
namespace {

struct Variant {
  const char* name;
  render::Counting counting;
  render::VolumeOptions options;
  shadow::FinderKind finder = shadow::FinderKind::automatic;
};

const std::vector<Variant>& variants() {
  using render::Counting;
  using enum shadow::Extrusion;
  using enum shadow::FinderKind;
  const render::VolumeOptions plain = render::kPlainVolumes;
  const auto by = [](render::VolumeOptions o, shadow::Extrusion extrusion) {
    o.extrusion = extrusion;
    return o;
  };
  const auto with = [&](bool finite, bool hiddenCasters, bool hiddenParts) {
    render::VolumeOptions o = plain;
    o.finite = finite, o.hiddenCasters = hiddenCasters, o.hiddenParts = hiddenParts;
    return o;
  };
  static const std::vector<Variant> all{{"zfail plain", Counting::zFail, plain},
                                        {"zfail finite", Counting::zFail, with(true, false, false)},
                                        {"zfail hidden casters", Counting::zFail, with(false, true, false)},
                                        {"zfail hidden parts", Counting::zFail, with(false, false, true)},
                                        {"zfail reduced", Counting::zFail, with(true, true, true)},
                                        {"zpass plain", Counting::zPass, plain},
                                        {"zpass finite", Counting::zPass, with(true, false, false)},
                                        {"zpass hidden casters", Counting::zPass, with(false, true, false)},
                                        {"zpass hidden parts", Counting::zPass, with(false, false, true)},
                                        {"zpass finite + casters", Counting::zPass, with(true, true, false)},
                                        {"zpass finite + parts", Counting::zPass, with(true, false, true)},
                                        {"zpass reduced", Counting::zPass, with(true, true, true)},
                                        {"zfail plain, cpu", Counting::zFail, by(plain, processor)},
                                        {"zfail plain, geometry", Counting::zFail, by(plain, geometryShader)},
                                        {"zfail plain, gpu", Counting::zFail, plain, gpu},
                                        {"zpass plain, cpu", Counting::zPass, by(plain, processor)},
                                        {"zpass plain, geometry", Counting::zPass, by(plain, geometryShader)},
                                        {"zpass plain, gpu", Counting::zPass, plain, gpu},
                                        {"zpass reduced, cpu", Counting::zPass, by({}, processor)},
                                        {"zpass reduced, geometry", Counting::zPass, by({}, geometryShader)},
                                        {"zpass reduced, gpu", Counting::zPass, {}, gpu}};
  return all;
}

// The first, and those with `word` in their names.
std::vector<Variant> variantsWith(std::string_view word) {
  std::vector<Variant> some = variants();
  some.erase(
      std::remove_if(some.begin() + 1, some.end(),
                     [&](const Variant& v) { return std::string_view(v.name).find(word) == std::string_view::npos; }),
      some.end());
  return some;
}

struct Times {
  std::vector<double> volumes, processor, shading, toPlain, toBare;
};

double least(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }
double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

double sum(const shadow::FrameStats& stats, std::initializer_list<std::string_view> names) {
  double total = 0.0;
  for (const shadow::PhaseTime& phase : stats.phases)
    if (std::find(names.begin(), names.end(), phase.name) != names.end()) total += phase.milliseconds;
  return total;
}

std::size_t differing(const image::GreyImage& a, const image::GreyImage& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a.pixels()[i] != b.pixels()[i];
  return count;
}

std::unique_ptr<shadow::Technique> make(const Variant& v, const std::shared_ptr<gl::Context>& context) {
  if (v.counting == render::Counting::zFail) return techniques::makeZFail(context, v.options);
  return techniques::makeZPass(context, v.options);
}

bool measure(const View& view, const std::vector<Variant>& chosen, int rounds,
             const std::shared_ptr<gl::Context>& context) {
  const shadow::Frame frame{view.camera, {&view.light, 1}};
  const auto askedFor = [&](const Variant& v) {
    shadow::Frame asked = frame;
    asked.silhouettes = v.finder;
    return asked;
  };
  auto truth = techniques::cpuTechniques().front().create();
  if (!truth || !(*truth)->prepare(view.geometry)) return false;
  const auto expected = (*truth)->shade(frame);
  const BareRays bare(view);
  std::vector<std::unique_ptr<shadow::Technique>> all;
  for (const Variant& v : chosen) {
    all.push_back(make(v, context));
    if (!all.back()->prepare(view.geometry)) return false;
    for (int i = 0; i < 2; ++i) (void)all.back()->shade(askedFor(v));  // shaders compile in the first frames
  }
  std::vector<Times> times(all.size());
  std::vector<shadow::Shading> last(all.size());
  std::vector<double> bareTimes;
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    (void)bare.mask(expected->surface);
    const double rays = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    bareTimes.push_back(rays);
    for (std::size_t i = 0; i < all.size(); ++i) {
      auto shading = all[i]->shade(askedFor(chosen[i]));
      if (!shading) return false;
      Times& t = times[i];
      t.volumes.push_back(sum(shading->stats, {"volumes"}));
      t.processor.push_back(sum(shading->stats, {"tiles", "silhouette", "useless", "layers", "extrude", "upload"}));
      t.shading.push_back(sum(shading->stats, {"facing", "lit"}) + t.volumes.back() + t.processor.back());
      t.toPlain.push_back(t.volumes.back() / times[0].volumes.back());
      t.toBare.push_back(t.shading.back() / rays);
      last[i] = std::move(*shading);
    }
  }
  std::printf("%s: bare rays %.1f ms (median %.1f)\n", view.name.c_str(), least(bareTimes), median(bareTimes));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Times& t = times[i];
    const shadow::LightStats& s = last[i].stats.lights[0];
    std::printf(
        "  %-24s volumes %7.1f %7.1f ms %6.3f | processor %5.1f | shading %7.1f ms, %5.2f of bare | %7zu triangles, "
        "casters hidden "
        "%zu behind %zu endless %zu, sides behind %zu | %zu pixels differ\n",
        chosen[i].name, least(t.volumes), median(t.volumes), median(t.toPlain), least(t.processor), least(t.shading),
        median(t.toBare), s.volumeTriangles, s.castersHidden, s.castersBehind, s.endlessCasters, s.sidesBehind,
        differing(last[i].masks[0].light, expected->masks[0].light));
    if (i == 4 || i + 1 == all.size()) {
      std::printf("      ");
      for (const auto& p : last[i].stats.phases) std::printf("%s %.1f  ", p.name.c_str(), p.milliseconds);
      std::printf("\n");
    }
  }
  std::fflush(stdout);
  return true;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  using namespace umbrage::benchmarks;
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 7;
  const std::string_view only = argc > 2 && argv[2] != std::string_view("all") ? argv[2] : "";
  const auto chosen = umbrage::benchmarks::variantsWith(argc > 3 ? argv[3] : "");
  const auto context = umbrage::gl::Context::createHeadless();
  if (!context) {
    std::printf("cannot run here: %s\n", context.error().text().c_str());
    return 1;
  }
  const std::pair<std::string_view, View (*)()> views[] = {{"city_air", cityAir},
                                                           {"city_street", cityStreet},
                                                           {"city_lamp", cityLamp},
                                                           {"grooved_knot", groovedKnotView},
                                                           {"knot", knot},
                                                           {"building_air", fromTheAir},
                                                           {"building_street", fromTheStreet}};
  for (const auto& [name, make] : views)
    if (only.empty() || name == only)
      if (!measure(make(), chosen, rounds, *context)) return 1;
  return 0;
}
