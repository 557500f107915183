#include "umbrage/radiosity/solve.hpp"

#include <algorithm>
#include <cmath>

#include "umbrage/parallel/for_each.hpp"
#include "umbrage/radiosity/detail/escape.hpp"
#include "umbrage/radiosity/detail/exchange.hpp"
#include "umbrage/radiosity/direct_light.hpp"

namespace umbrage::radiosity {
namespace {

using detail::Factor;
using detail::Patches;
using detail::Side;

constexpr double kPatchesPerRadius = 5.0, kElementsPerPatch = 16.0;
constexpr std::size_t kPointsPerBlock = 64;

double sumOf(const Vec3& v) { return v.x + v.y + v.z; }
double luminance(const Vec3& v) { return 0.2126 * v.x + 0.7152 * v.y + 0.0722 * v.z; }

/// Lengths that are not given follow from the scene's size.
Options completed(Options options, const scene::Surfaces& surfaces) {
  const Box3& box = surfaces.casterBounds.empty() ? surfaces.bounds : surfaces.casterBounds;
  if (!(options.patch > 0.0)) options.patch = box.empty() ? 1.0 : std::max(box.radius(), 1e-30) / kPatchesPerRadius;
  if (!(options.element > 0.0)) options.element = options.patch / kElementsPerPatch;
  return options;
}

class Solver {
 public:
  Solver(const scene::Scene& scene, const trace::Occlusion& occlusion, Subdivision& mesh, Patches& patches,
         std::vector<DirectLight> lights, const Options& options)
      : scene_(scene),
        occlusion_(occlusion),
        mesh_(mesh),
        patches_(patches),
        lights_(std::move(lights)),
        options_(options),
        exchange_(occlusion, mesh, patches, options.visibility, options.memory),
        shot_(2 * patches.count(), Vec3(0.0)),
        mean_(2 * patches.count(), Vec3(0.0)) {
    for (std::size_t p = 0; p < patches.count(); ++p)
      materials_.push_back(&materialOf(mesh.vertices()[mesh.elements()[patches.element(p)].centre].sheet));
  }

  Result<void> run(const ProgressSink& progress);
  void finish(Solution& solution) const;

 private:
  [[nodiscard]] const scene::Material& materialOf(std::uint32_t sheet) const {
    return scene_.materials[mesh_.sheets()[sheet].material];
  }
  [[nodiscard]] const scene::Material& materialOfPatch(std::size_t patch) const { return *materials_[patch]; }
  [[nodiscard]] Vec3 exitance(Side receiver) const {
    const scene::Material& material = materialOf(mesh_.vertices()[receiver / 2].sheet);
    return material.emission + material.colour * received_[receiver];
  }
  /// What a side of a patch gives off, and what of that it has not given off yet.
  [[nodiscard]] Vec3 leaving(Side patch) const {
    const scene::Material& material = materialOfPatch(patch / 2);
    return material.emission + material.colour * mean_[patch];
  }
  [[nodiscard]] Vec3 unshot(Side patch) const { return leaving(patch) - shot_[patch]; }

  void placeSamples(std::size_t first);
  [[nodiscard]] Result<void> light(std::size_t first);
  [[nodiscard]] Vec3 meanOf(const std::vector<Vec3>& light, Side patch) const;
  void sumEmitted();
  void average();
  [[nodiscard]] Result<void> shoot();
  [[nodiscard]] bool shinesByItself(Side patch) const { return materialOfPatch(patch / 2).emission != Vec3(0.0); }
  [[nodiscard]] Result<bool> refine();
  [[nodiscard]] Result<bool> refineAll(const ProgressSink& progress, double fraction);
  [[nodiscard]] bool isUneven(const Element& element, double threshold) const;
  [[nodiscard]] Result<void> catchUp(std::size_t first);
  [[nodiscard]] Balance balance() const;

  const scene::Scene& scene_;
  const trace::Occlusion& occlusion_;
  Subdivision& mesh_;
  Patches& patches_;
  std::vector<DirectLight> lights_;
  Options options_;
  detail::Exchange exchange_;
  std::vector<const scene::Material*> materials_;  ///< of patches
  std::vector<Vec3> received_, direct_;            ///< per side of a vertex; `direct_`: of it, from lights of the scene
  std::vector<Vec3> shot_, mean_;        ///< per side of a patch: given off so far; the mean of what was received
  Side brightest_ = 0;                   ///< with the most unshot light
  double emitted_ = 0.0, unshot_ = 0.0;  ///< sums over channels
  SolveStats stats_;
};

void Solver::placeSamples(std::size_t first) {
  // Four lifts: farther inside than rays start above.
  mesh_.placeSamples(first, [&](const Vertex& v) { return 4.0 * liftOf(occlusion_, v.triangle, v.position); });
}

// The light of the scene's lights on vertices from `first` on.
Result<void> Solver::light(std::size_t first) {
  const std::size_t count = mesh_.vertices().size();
  received_.resize(2 * count, Vec3(0.0));
  direct_.resize(2 * count, Vec3(0.0));
  const std::size_t blocks = (count - first + kPointsPerBlock - 1) / kPointsPerBlock;
  return parallel::forEach(static_cast<int>(blocks), [&](int block) {
    const std::size_t begin = first + static_cast<std::size_t>(block) * kPointsPerBlock;
    std::vector<SurfacePoint> points;
    for (std::size_t v = begin; v < std::min(count, begin + kPointsPerBlock); ++v) {
      const Vertex& vertex = mesh_.vertices()[v];
      points.push_back({vertex.sample, mesh_.sheets()[vertex.sheet].normal, vertex.triangle});
    }
    std::vector<std::array<double, 2>> parts(points.size());
    for (const DirectLight& each : lights_) {
      each.seen(points, parts);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto sides = each.received(points[i], parts[i]);
        for (std::size_t s = 0; s < 2; ++s) direct_[2 * (begin + i) + s] += sides[s];
      }
    }
    for (std::size_t i = 2 * begin; i < 2 * (begin + points.size()); ++i) received_[i] = direct_[i];
  });
}

Vec3 Solver::meanOf(const std::vector<Vec3>& light, Side patch) const {
  Vec3 mean(0.0);
  for (const auto& [vertex, weight] : patches_.weights(patch / 2)) mean += weight * light[2 * vertex + patch % 2];
  return mean;
}

void Solver::sumEmitted() {
  emitted_ = 0.0;
  for (Side side = 0; side < mean_.size(); ++side)
    emitted_ += patches_.area(side / 2) * sumOf(materialOfPatch(side / 2).emission + meanOf(direct_, side));
}

// Means of patches, and what follows from them.
void Solver::average() {
  unshot_ = 0.0;
  double most = -1.0;
  for (Side side = 0; side < mean_.size(); ++side) {
    mean_[side] = meanOf(received_, side);
    const double waiting = patches_.area(side / 2) * sumOf(glm::abs(unshot(side)));
    unshot_ += waiting;
    if (waiting > most) most = waiting, brightest_ = side;
  }
  stats_.unshotPart = emitted_ > 0.0 ? unshot_ / emitted_ : 0.0;
}

Result<void> Solver::shoot() {
  const auto factors = exchange_.from(brightest_);
  if (!factors) return tl::unexpected(factors.error());
  const Vec3 light = unshot(brightest_);
  for (const auto& [receiver, factor] : *factors) received_[receiver] += double(factor) * light;
  shot_[brightest_] += light;
  ++stats_.shots;
  average();
  return {};
}

bool Solver::isUneven(const Element& element, double threshold) const {
  const Vec3 albedo = materialOf(mesh_.vertices()[element.centre].sheet).colour;
  for (std::uint32_t s = 0; s < 2; ++s) {
    double low = luminance(albedo * received_[2 * element.centre + s]), high = low;
    for (const std::uint32_t corner : element.corner) {
      const double here = luminance(albedo * received_[2 * corner + s]);
      low = std::min(low, here), high = std::max(high, here);
    }
    if (high - low > threshold) return true;
  }
  return false;
}

// Gives new vertices all that was shot before they were there.
Result<void> Solver::catchUp(std::size_t first) {
  if (auto lit = light(first); !lit) return lit;
  std::vector<Side> emitters;
  for (Side side = 0; side < shot_.size(); ++side)
    if (shot_[side] != Vec3(0.0)) emitters.push_back(side);
  struct Late {
    Side emitter;
    Factor factor;
  };
  std::vector<std::vector<Late>> late(mesh_.vertices().size() - first);
  const auto done = parallel::forEach(static_cast<int>(late.size()), [&](int i) {
    const auto vertex = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(i);
    exchange_.to(vertex, emitters, [&](Side emitter, Side receiver, double factor) {
      late[static_cast<std::size_t>(i)].push_back({emitter, {receiver, static_cast<float>(factor)}});
    });
  });
  if (!done) return done;
  for (const auto& ofVertex : late) {
    for (const Late& one : ofVertex) {
      received_[one.factor.receiver] += double(one.factor.factor) * shot_[one.emitter];
      exchange_.add(one.emitter, one.factor);
    }
  }
  exchange_.grow(mesh_.vertices().size());
  return {};
}

// Cuts elements once where light is uneven; false where it is even everywhere.
Result<bool> Solver::refine() {
  double area = 0.0, light = 0.0;
  for (std::size_t p = 0; p < patches_.count(); ++p) {
    for (std::size_t s = 0; s < 2; ++s) {
      const double here = luminance(materialOfPatch(p).colour * mean_[2 * p + s]);
      if (!(here > 0.0)) continue;
      area += patches_.area(p), light += patches_.area(p) * here;
    }
  }
  if (!(light > 0.0) || !(options_.error > 0.0)) return false;
  const double threshold = options_.error * light / area;
  const std::size_t first = mesh_.vertices().size();
  const auto elements = static_cast<std::uint32_t>(mesh_.elements().size());
  for (std::uint32_t e = 0; e < elements && mesh_.elements().size() < options_.mostElements; ++e) {
    const Element& element = mesh_.elements()[e];
    if (element.children == 0 && mesh_.longestEdge(element) >= 2.0 * options_.element && isUneven(element, threshold))
      mesh_.split(e);
  }
  if (mesh_.vertices().size() == first) return false;
  ++stats_.refinements;
  placeSamples(first);
  if (auto done = catchUp(first); !done) return tl::unexpected(done.error());
  patches_.weigh(mesh_);
  sumEmitted();
  average();
  return true;
}

// False where somebody has had enough.
Result<bool> Solver::refineAll(const ProgressSink& progress, double fraction) {
  while (true) {
    if (!reportProgress(progress, fraction, "cutting elements")) return false;
    const auto refined = refine();
    if (!refined || !*refined) return refined ? Result<bool>(true) : refined;
  }
}

// Elements are cut twice: once the light of all that shines by itself is out, whose shadows are the sharpest, and at the end.
Result<void> Solver::run(const ProgressSink& progress) {
  placeSamples(0);
  if (auto lit = light(0); !lit) return lit;
  sumEmitted();
  average();
  std::size_t waiting = 0;  // patches that shine by themselves and have not shot yet
  for (Side side = 0; side < shot_.size(); ++side) waiting += shinesByItself(side);
  double fraction = 0.0;
  const auto isDone = [&] { return stats_.unshotPart <= options_.unshot || stats_.shots >= options_.mostShots; };
  for (int cuts = 0; cuts < 2 || !isDone();) {
    const bool done = isDone();
    if ((cuts == 0 && waiting == 0) || (cuts < 2 && done)) {
      ++cuts;
      const auto goOn = refineAll(progress, fraction);
      if (!goOn) return tl::unexpected(goOn.error());
      if (!*goOn) return {};
      continue;
    }
    // What is unshot falls exponentially.
    fraction = std::clamp(std::log(stats_.unshotPart) / std::log(options_.unshot), fraction, 1.0);
    if (!reportProgress(progress, fraction, "shooting light")) return {};
    if (shinesByItself(brightest_) && shot_[brightest_] == Vec3(0.0)) --waiting;
    if (auto shot = shoot(); !shot) return shot;
  }
  stats_.converged = stats_.unshotPart <= options_.unshot;
  return {};
}

Balance Solver::balance() const {
  Balance sum;
  std::vector<double> lost(shot_.size(), 0.0);
  const auto done = parallel::forEach(static_cast<int>(shot_.size()), [&](int side) {
    const auto i = static_cast<Side>(side);
    if (shot_[i] != Vec3(0.0)) lost[i] = detail::escaping(occlusion_, exchange_.emitterOf(i));
  });
  for (std::size_t p = 0; p < patches_.count(); ++p) {
    const scene::Material& material = materialOfPatch(p);
    for (std::size_t s = 0; s < 2; ++s) {
      const auto side = static_cast<Side>(2 * p + s);
      const double area = patches_.area(p);
      sum.emitted += area * (material.emission + meanOf(direct_, side));
      sum.absorbed += area * (1.0 - material.colour) * mean_[side];
      sum.escaped += area * lost[side] * shot_[side];
      sum.unshot += area * unshot(side);
    }
  }
  if (!done) sum.escaped = Vec3(0.0);
  return sum;
}

void Solver::finish(Solution& solution) const {
  solution.stats = stats_;
  solution.stats.patches = 2 * patches_.count();
  solution.stats.vertices = mesh_.vertices().size();
  for (const Element& element : mesh_.elements()) solution.stats.elements += element.children == 0;
  solution.stats.factors = exchange_.computed();
  solution.balance = balance();
  for (Side v = 0; v < mesh_.vertices().size(); ++v)
    solution.exitance.push_back({exitance(2 * v), exitance(2 * v + 1)});
  // Light that is spread evenly over all sides falls on all again, less what they absorb.
  double area = 0.0;
  Vec3 albedo(0.0);
  for (std::size_t p = 0; p < patches_.count(); ++p)
    area += patches_.area(p), albedo += patches_.area(p) * materialOfPatch(p).colour;
  if (area > 0.0)
    solution.ambient =
        glm::max(Vec3(0.0), solution.balance.unshot) / (2.0 * area) / glm::max(1.0 - albedo / area, Vec3(0.01));
}

}  // namespace

double Balance::error() const {
  const double all = sumOf(emitted);
  return all > 0.0 ? sumOf(absorbed + escaped + unshot - emitted) / all : 0.0;
}

namespace {

/// No paint is whiter, and in a closed room of albedo 1 light would never end.
constexpr double kWhitest = 0.98;

scene::Scene paintable(scene::Scene scene) {
  for (scene::Material& material : scene.materials) material.colour = glm::min(material.colour, Vec3(kWhitest));
  return scene;
}

}  // namespace

Result<Solution> solve(const scene::Scene& given, std::span<const scene::Light> lights, const Options& asked,
                       const ProgressSink& progress) {
  const scene::Scene scene = paintable(given);
  const auto surfaces = std::make_shared<const scene::Surfaces>(scene::flatten(scene));
  const Options options = completed(asked, *surfaces);
  auto occlusion = trace::Occlusion::build(surfaces);
  if (!occlusion) return tl::unexpected(occlusion.error());
  Solution solution{surfaces, Subdivision(*surfaces), {}, {}, {}, {}};
  const Box3& near = surfaces->casterBounds.empty() ? surfaces->bounds : surfaces->casterBounds;
  auto patches = Patches::cut(solution.mesh, near, options.patch, options.element <= 0.5 * options.patch);
  if (!patches) return tl::unexpected(patches.error());
  Box3 room = surfaces->bounds;
  if (!room.empty()) room.min += surfaces->origin, room.max += surfaces->origin;
  std::vector<DirectLight> direct;
  for (const scene::Light& light : lights) direct.emplace_back(*occlusion, light, options.lightSamples, room);
  Solver solver(scene, *occlusion, solution.mesh, *patches, std::move(direct), options);
  if (auto done = solver.run(progress); !done) return tl::unexpected(done.error());
  solver.finish(solution);
  return solution;
}

}  // namespace umbrage::radiosity
