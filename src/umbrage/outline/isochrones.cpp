#include "umbrage/outline/isochrones.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "umbrage/base/check.hpp"
#include "umbrage/outline/detail/quadtree.hpp"
#include "umbrage/scene/camera.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::outline {
namespace {

using detail::Cell;
using detail::Extent;
using detail::Grid;
using detail::Knot;
using detail::Quadtree;
using std::chrono::milliseconds;

constexpr double kMostCells = 1e6;  // of the coarsest
constexpr double kFarthest = 40.0;  // beyond the casters, in their heights: the sun at 1.4 degrees
constexpr milliseconds kLook{60'000};
constexpr int kRounds = 8;             // of checking and refining
constexpr double kStep = 1.0 / 256.0;  // of Quadtree::loops

// How far from casters of height 1 a point can miss as much sun as the border needs: its sun is hidden only while it is lower than
// the top of what hides it.
double reachOf(const study::SunCourse& course, milliseconds leastShadow) {
  std::vector<double> tangents;  // of the sun's elevation, a sample a minute
  for (const study::TimeSpan& up : course.up())
    for (auto t = up.from; t < up.to; t += kLook) {
      const Vec3 s = course.towards(t);
      tangents.push_back(std::max(1e-9, s.z) / std::max(1e-9, std::hypot(s.x, s.y)));
    }
  std::sort(tangents.begin(), tangents.end());
  // One sample short, so that what lies between samples does not matter.
  const auto missed = static_cast<std::size_t>(std::max<std::int64_t>(1, leastShadow / kLook) - 1);
  return missed < tangents.size() ? 1.0 / tangents[missed] : 0.0;
}

class Mapper {
 public:
  Mapper(const scene::Scene& scene, const study::ExactHours& hours, const study::SunCourse& course,
         const IsochroneOptions& options, const ProgressSink& progress)
      : scene_(scene), hours_(hours), course_(course), options_(options), progress_(progress) {}

  [[nodiscard]] Result<Isochrones> run();

 private:
  [[nodiscard]] Extent extent() const;
  [[nodiscard]] bool evaluate(const std::vector<Vec2>& points, std::vector<double>& values);
  [[nodiscard]] Vec2 place(const Vec2& inCells) const { return origin_ + step_ * inCells; }
  [[nodiscard]] bool check(Quadtree& tree, std::mt19937_64& random);

  const scene::Scene& scene_;
  const study::ExactHours& hours_;
  const study::SunCourse& course_;
  const IsochroneOptions& options_;
  const ProgressSink& progress_;
  Vec2 origin_{0.0};
  double step_ = 1.0;
  std::int32_t columns_ = 0, rows_ = 0;
  Isochrones result_;
};

Extent Mapper::extent() const {
  const Box3 box = scene::bounds(scene_, true);
  Extent extent;
  if (box.empty()) return extent;
  extent.add(study::mapPoint(box.min, scene_.up));
  extent.add(study::mapPoint(box.max, scene_.up));
  const double height = std::max(0.0, study::mapHeight(box.max, scene_.up) - options_.height);
  const milliseconds least =
      options_.of == HoursOf::shadow ? options_.levels.front() : course_.upTime() - options_.levels.back();
  const double margin = height * std::min(kFarthest, least > milliseconds(0) ? reachOf(course_, least) : 0.0);
  extent.min -= margin + 8.0 * step_;
  extent.max += margin + 8.0 * step_;
  return extent;
}

bool Mapper::evaluate(const std::vector<Vec2>& points, std::vector<double>& values) {
  std::vector<study::Receiver> receivers;
  receivers.reserve(points.size());
  const Vec3 up = scene::upVector(scene_.up);
  for (const Vec2& p : points) receivers.push_back({study::scenePoint(p, options_.height, scene_.up), up});
  const auto lit = hours_.at(receivers, course_, progress_);
  if (!lit) return false;
  const auto whole = double(course_.upTime().count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto total = double(lit->total(i).count());
    values.push_back(options_.of == HoursOf::sun ? total : whole - total);
  }
  result_.samples += points.size();
  return true;
}

// Random points against the map: where it is wrong far from its borders it is refined. False: cancelled.
bool Mapper::check(Quadtree& tree, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across(0.0, double(columns_) * Quadtree::kCoarsest);
  std::uniform_real_distribution<double> along(0.0, double(rows_) * Quadtree::kCoarsest);
  std::vector<Vec2> cells, points;
  for (std::size_t n = 0; n < options_.checks; ++n) {
    const double x = across(random);
    cells.emplace_back(x, along(random));
    points.push_back(place(cells.back()));
  }
  std::vector<double> values;
  if (!evaluate(points, values)) return false;
  result_.checked = points.size();
  result_.wrong = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Cell leaf = tree.leafAt(cells[n]);
    if (tree.crosses(leaf) || !tree.contradicts(leaf, values[n])) continue;
    ++result_.wrong;
    tree.refineAt(cells[n]);
  }
  return true;
}

Result<Isochrones> Mapper::run() {
  // A border lies within a finest cell, whose diagonal is the tolerance.
  step_ = options_.tolerance / std::sqrt(2.0);
  const Extent whole = extent();
  if (whole.empty()) return fail(ErrorCode::input, "has nothing that casts shadows", scene_.source);
  const Vec2 size = whole.max - whole.min;
  const double coarse = step_ * Quadtree::kCoarsest;
  if (std::ceil(size.x / coarse) * std::ceil(size.y / coarse) > kMostCells)
    return fail(ErrorCode::usage, "the tolerance is too fine for so large a scene", scene_.source);
  origin_ = whole.min;
  columns_ = static_cast<std::int32_t>(std::ceil(size.x / coarse));
  rows_ = static_cast<std::int32_t>(std::ceil(size.y / coarse));

  std::vector<double> levels;
  for (const milliseconds level : options_.levels) levels.push_back(double(level.count()));
  Quadtree tree(columns_, rows_, levels, [this](std::span<const Knot> knots, std::vector<double>& values) {
    std::vector<Vec2> points;
    for (const Knot& k : knots) points.push_back(place(Vec2(k.i, k.j)));
    return evaluate(points, values);
  });
  const auto cancelled = [] { return fail(ErrorCode::cancelled, "cancelled"); };
  if (!tree.settle()) return cancelled();
  std::mt19937_64 random(1);
  for (int round = 0; options_.checks > 0 && round < kRounds; ++round) {
    if (!check(tree, random)) return cancelled();
    if (result_.wrong == 0) break;
    if (!tree.settle()) return cancelled();
  }
  const Grid grid(origin_, step_ * kStep);
  for (const double level : levels) result_.regions.push_back(detail::unite(tree.loops(level), grid));
  result_.min = origin_;
  result_.max = place(Vec2(columns_, rows_) * double(Quadtree::kCoarsest));
  result_.cutOff = tree.reachesRim();
  return std::move(result_);
}

}  // namespace

Result<Isochrones> isochrones(const scene::Scene& scene, const study::ExactHours& hours, const study::SunCourse& course,
                              const IsochroneOptions& options, const ProgressSink& progress) {
  UMBRAGE_CHECK(options.tolerance > 0.0 && !options.levels.empty(), "no tolerance or no levels");
  UMBRAGE_CHECK(
      options.levels.front() > milliseconds(0) && std::is_sorted(options.levels.begin(), options.levels.end()),
      "levels that do not ascend from above 0");
  return Mapper(scene, hours, course, options, progress).run();
}

}  // namespace umbrage::outline
