// Long searches for pixels that differ from the truth.
//   sweep scenes [VIEWS]      VIEWS more views (default 40) of every scene in code: random eyes, and eyes at 0, 1e-6 .. 1e-2 of the
//                             scene's size from sides of shadow volumes, where z-pass is weakest
//   sweep models DIR..        every loadable model below DIRs, on a ground, with a sun and a lamp; a model fails when more than 1
//                             pixel in 100,000 is far from a true edge
// Ends with exit code 1 when something failed.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "conformance/judge.hpp"
#ifdef UMBRAGE_HAVE_IO
#include "conformance/models.hpp"
#endif

namespace umbrage::conformance {
namespace {

constexpr double kWorstShare = 1e-5;
// Where corners of silhouettes meet on a surface that is dark anyway, a snapped corner may count one side and miss the next: single
// pixels in millions, found only by searching.
constexpr double kWorstShareInCode = 1e-6;

// Every technique on one geometry; prints a line each. False when one failed.
bool judgeAll(const std::string& name, const std::shared_ptr<const shadow::Geometry>& geometry,
              const std::vector<NamedView>& views, const std::vector<NamedLight>& lights, double worstShare) {
  bool good = true;
  std::vector<shadow::TechniqueEntry> entries = allTechniques();
  for (auto& way : askedWays()) entries.push_back(std::move(way));
  for (const shadow::TechniqueEntry& entry : entries) {
    if (entry.traits.name == allTechniques().front().traits.name) continue;
    if (entry.traits.needsClosed && geometry->casters.report.topology != mesh::Topology::closed) continue;
    auto judge = Judge::make(entry, geometry);
    if (!judge) {
      std::printf("%-36s %-8s cannot run: %s\n", name.c_str(), entry.traits.name.c_str(), judge.error().text().c_str());
      continue;
    }
    Tally tally;
    std::string worst;
    for (const NamedView& view : views) {
      const auto verdicts = judge->judge(view, lights);
      if (!verdicts) {
        std::printf("%-36s %-8s %s\n", name.c_str(), entry.traits.name.c_str(), verdicts.error().text().c_str());
        return false;
      }
      for (const Verdict& v : *verdicts) {
        tally.add(v);
        if (v.difference.farFromEdge != 0)
          worst += " " + v.view + "/" + v.light + ":" + std::to_string(v.difference.farFromEdge);
      }
    }
    const bool pass = double(tally.far) <= worstShare * double(tally.covered);
    good = good && pass;
    std::printf("%-36s %-8s %8zu triangles %4zu masks %9zu covered %6zu differing %5zu far %s%s\n", name.c_str(),
                entry.traits.name.c_str(), geometry->surfaces.triangles.size(), tally.masks, tally.covered,
                tally.differing, tally.far, pass ? "ok" : "FAILED", worst.substr(0, 200).c_str());
    std::fflush(stdout);
  }
  return good;
}

// --- scenes in code --------------------------------------------------------------------------------------------------------

bool sweepScenes(int count) {
  bool good = true;
  for (const std::string& name : sceneNames()) {
    Case c = makeCase(name);
    const auto geometry = shadow::makeGeometry(c.scene);
    c.views = searchViews(c, *geometry, count);
    good = judgeAll(name, geometry, c.views, c.lights, kWorstShareInCode) && good;
  }
  return good;
}

// --- real models -----------------------------------------------------------------------------------------------------------

#ifdef UMBRAGE_HAVE_IO
bool sweepModel(const std::filesystem::path& path) {
  const auto c = modelCase(path);
  if (!c) {
    std::printf("%-36s not loaded: %s\n", path.filename().c_str(), c.error().message.c_str());
    return true;
  }
  return judgeAll(c->name, shadow::makeGeometry(c->scene), c->views, c->lights, kWorstShare);
}

bool sweepModels(int count, char** directories) {
  bool good = true;
  for (int i = 0; i < count; ++i) {
    for (const auto& path : modelFiles(directories[i])) good = sweepModel(path) && good;
  }
  return good;
}
#else
bool sweepModels(int, char**) {
  std::printf("this build reads no files\n");
  return false;
}
#endif

}  // namespace
}  // namespace umbrage::conformance

int main(int argc, char** argv) {
  using namespace umbrage::conformance;
  const std::string_view mode = argc > 1 ? argv[1] : "";
  if (mode == "scenes") return sweepScenes(argc > 2 ? std::atoi(argv[2]) : 40) ? 0 : 1;
  if (mode == "models" && argc > 2) return sweepModels(argc - 2, argv + 2) ? 0 : 1;
  std::printf("usage: sweep scenes [VIEWS] | sweep models DIR..\n");
  return 2;
}
