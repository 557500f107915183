#include "umbrage/rules/inverse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/detail/judge.hpp"
#include "umbrage/rules/detail/outlines.hpp"
#include "umbrage/study/georeference.hpp"

namespace umbrage::rules {
namespace {

using detail::Lights;
using detail::SunOf;
using outline::Region;

constexpr double kFine = 1e-3;  // of a height: how closely its limit is found
constexpr int kTries = 4;
constexpr double kWhole = 1e-6;     // of a site: what it may be longer than whole cells
constexpr double kSmallest = 1e-6;  // of a cell: pieces of the site below are left out

// A piece of a plan between two parallels: a convex quadrangle (or triangle).
using Slice = std::vector<Vec2>;

// A region as slices between the heights of its corners.
std::vector<Slice> slicesOf(const Region& region) {
  std::vector<double> levels;
  std::vector<std::pair<Vec2, Vec2>> edges;
  const auto add = [&](const outline::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      levels.push_back(ring[i].y);
      edges.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
    }
  };
  for (const outline::Polygon& polygon : region.polygons) {
    add(polygon.outer);
    for (const outline::Ring& hole : polygon.holes) add(hole);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  std::vector<Slice> slices;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    const double low = levels[k], high = levels[k + 1], middle = 0.5 * (low + high);
    const auto at = [](const auto& edge, double y) {
      const auto& [a, b] = edge;
      return a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
    };
    std::vector<std::pair<Vec2, Vec2>> across;
    for (const auto& edge : edges)
      if (std::min(edge.first.y, edge.second.y) <= low && std::max(edge.first.y, edge.second.y) >= high)
        across.push_back(edge);
    std::sort(across.begin(), across.end(),
              [&](const auto& a, const auto& b) { return at(a, middle) < at(b, middle); });
    for (std::size_t i = 0; i + 1 < across.size(); i += 2)
      slices.push_back({{at(across[i], low), low},
                        {at(across[i + 1], low), low},
                        {at(across[i + 1], high), high},
                        {at(across[i], high), high}});
  }
  return slices;
}

// Closed and wound outwards, in the scene's frame.
void addPrism(mesh::Mesh& m, const Slice& plan, double base, double top, scene::UpAxis up) {
  const auto first = static_cast<std::uint32_t>(m.positions.size());
  const auto n = static_cast<std::uint32_t>(plan.size());
  for (const double height : {base, top})
    for (const Vec2& p : plan) m.positions.push_back(study::scenePoint(p, height, up));
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = (i + 1) % n;
    m.triangles.push_back({first + i, first + k, first + k + n});
    m.triangles.push_back({first + i, first + k + n, first + i + n});
    if (i == 0 || i + 1 >= n) continue;
    m.triangles.push_back({first, first + i + 1, first + i});
    m.triangles.push_back({first + n, first + n + i, first + n + i + 1});
  }
}

Result<std::vector<Column>> columnsOf(const Area& site, const scene::Scene& scene, const InverseOptions& options) {
  const double unit = scene.metresPerUnit;
  const double cell =
      options.cell > 0.0 ? options.cell / unit : std::sqrt(site.region.area / (double(kMostColumns) / 4.0));
  Vec2 low(1e300), high(-1e300);
  for (const outline::Polygon& polygon : site.region.polygons)
    for (const Vec2& p : polygon.outer) low = glm::min(low, p), high = glm::max(high, p);
  // Around the middle, so that a site of whole cells is cut into whole cells, in whatever unit its corners were rounded.
  const Vec2 count = glm::max(glm::ceil((high - low) / cell * (1.0 - kWhole)), Vec2(1.0));
  if (count.x * count.y > 64.0 * double(kMostColumns))
    return fail(ErrorCode::usage,
                fmt::format("a site this large has too many columns of {:g} m; take larger ones", cell * unit));
  const Vec2 origin = 0.5 * (low + high) - 0.5 * cell * count;
  std::vector<Column> columns;
  for (double j = 0; j < count.y; ++j)
    for (double i = 0; i < count.x; ++i) {
      const Vec2 a = origin + cell * Vec2(i, j), b = a + cell;
      Region square;
      square.polygons.push_back({{a, {b.x, a.y}, b, {a.x, b.y}}, {}});
      square.area = cell * cell;
      Column column{outline::common(site.region, square)};
      if (column.plan.area > kSmallest * square.area) columns.push_back(std::move(column));
    }
  if (columns.size() > kMostColumns)
    return fail(ErrorCode::usage, fmt::format("the site has {} columns of {:g} m, more than {}; take larger ones",
                                              columns.size(), cell * unit, kMostColumns));
  return columns;
}

// The instances of the columns behind those of a scene.
scene::Scene withColumns(scene::Scene scene, const std::vector<Column>& columns, double base) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].height <= 0.0) continue;
    mesh::Mesh m;
    m.name = fmt::format("{} {}", kColumnName, i + 1);
    for (const Slice& slice : slicesOf(columns[i].plan))
      addPrism(m, slice, base, base + columns[i].height / scene.metresPerUnit, scene.up);
    scene.instances.push_back({m.name, static_cast<std::uint32_t>(scene.meshes.size())});
    scene.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  }
  if (scene.materials.empty()) scene.materials.push_back({});
  return scene;
}

// The sun of what stands does not change while the volume does; it is worked out once for each day and set of receivers.
class Standing {
 public:
  explicit Standing(SunOf sun) : sun_(std::move(sun)) {}
  [[nodiscard]] Result<const study::SunHours*> at(std::span<const study::Receiver> receivers,
                                                  const study::SunCourse& course, const ProgressSink& progress) {
    const Key key{course.span().from, course.span().to, receivers.size(), mark(receivers)};
    auto found = known_.find(key);
    if (found == known_.end()) {
      auto hours = sun_(receivers, course, progress);
      if (!hours) return tl::unexpected(hours.error());
      found = known_.emplace(key, std::move(*hours)).first;
    }
    return &found->second;
  }

 private:
  using Key = std::tuple<sun::Instant, sun::Instant, std::size_t, double>;
  static double mark(std::span<const study::Receiver> receivers) {
    double sum = 0.0;
    for (std::size_t i = 0; i < receivers.size(); ++i)
      sum += (1.0 + double(i)) * glm::dot(receivers[i].position, Vec3(1.0, 3.7, 11.3));
    return sum;
  }
  SunOf sun_;
  std::map<Key, study::SunHours> known_;
};

study::SunHours bothLit(const study::SunHours& a, const study::SunHours& b) {
  std::vector<std::size_t> begin{0};
  std::vector<study::TimeSpan> lit;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (const study::TimeSpan& span : detail::both(a.lit(i), b.lit(i))) lit.push_back(span);
    begin.push_back(lit.size());
  }
  return {std::move(begin), std::move(lit)};
}

class Grower {
 public:
  /// `stands`: what casts beside the columns.
  Grower(const scene::Scene& stands, const scene::Scene* baseline, const Rule& rule, const TargetSet& targets,
         const VerifyRequest& request, const InverseOptions& options, Lights standing, std::vector<Column> columns,
         const ProgressSink& progress)
      : stands_(stands),
        baseline_(baseline),
        rule_(rule),
        targets_(targets),
        request_(request),
        options_(options),
        before_(std::move(standing.before)),
        standing_(std::move(standing.now)),
        columns_(std::move(columns)),
        progress_(progress),
        frame_(stands) {
    frame_.instances.clear(), frame_.meshes.clear();
  }

  [[nodiscard]] Result<void> run() {
    const auto bare = passes(columns_);
    if (!bare) return tl::unexpected(bare.error());
    if (!*bare) return fail(ErrorCode::usage, fmt::format("{} fails already with nothing on the site", rule_.name));
    std::vector<bool> open(columns_.size(), true);
    while (std::any_of(open.begin(), open.end(), [](bool o) { return o; })) {
      if (const auto grown = grow(open); !grown) return grown;
      bool closed = false;
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (!open[i]) continue;
        const auto more = raised(i);
        if (!more) return tl::unexpected(more.error());
        if (*more) continue;
        open[i] = false, closed = true;
      }
      if (closed) continue;
      // Only together they fail: from here one after the other.
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (!open[i]) continue;
        std::vector<bool> one(columns_.size(), false);
        one[i] = true;
        if (const auto grown = grow(one); !grown) return grown;
        open[i] = false;
      }
    }
    for (Column& column : columns_) column.bounded = column.height < options_.most;
    return {};
  }

  [[nodiscard]] std::vector<Column> take() { return std::move(columns_); }
  [[nodiscard]] std::size_t trials() const { return trials_; }

 private:
  // Raises those that are open together, by the same height, as far as the rule lets them.
  [[nodiscard]] Result<void> grow(const std::vector<bool>& open) {
    double least = options_.most, highest = 0.0;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (open[i]) least = std::min(least, columns_[i].height), highest = std::max(highest, columns_[i].height);
    const auto at = [&](double height) {
      std::vector<Column> trial = columns_;
      for (std::size_t i = 0; i < trial.size(); ++i)
        if (open[i]) trial[i].height = std::max(trial[i].height, height);
      return trial;
    };
    double low = least, high = options_.most;
    const auto top = passes(at(high));
    if (!top) return tl::unexpected(top.error());
    if (*top) low = high;
    while (high - low > std::max(kFine * low, 0.1 * kRaiseLeast)) {
      const double middle = low > 0.0 && high > 4.0 * low ? std::sqrt(low * high) : 0.5 * (low + high);
      const auto fine = passes(at(middle));
      if (!fine) return tl::unexpected(fine.error());
      (*fine ? low : high) = middle;
    }
    columns_ = at(low);
    return {};
  }

  // Does it still pass with this column raised? One that has reached the most cannot be.
  [[nodiscard]] Result<bool> raised(std::size_t i) {
    if (columns_[i].height >= options_.most) return false;
    std::vector<Column> trial = columns_;
    trial[i].height += std::max(kRaise * trial[i].height, kRaiseLeast);
    return passes(trial);
  }

  [[nodiscard]] Result<bool> passes(const std::vector<Column>& columns) {
    ++trials_;
    const double closed =
        double(std::count_if(columns.begin(), columns.end(), [&](const Column& c) { return c.height > 0.0; }));
    if (!reportProgress(progress_, closed / double(columns.size() + 1), "volume"))
      return fail(ErrorCode::cancelled, "cancelled");
    auto hours = study::ExactHours::build(withColumns(frame_, columns, options_.base), request_.place);
    if (!hours) return tl::unexpected(hours.error());
    const SunOf own = detail::sunOf(std::make_shared<const study::ExactHours>(std::move(*hours)));
    const SunOf now = [&](std::span<const study::Receiver> receivers, const study::SunCourse& course,
                          const ProgressSink& progress) -> Result<study::SunHours> {
      const auto standing = standing_.at(receivers, course, progress);
      if (!standing) return tl::unexpected(standing.error());
      auto lit = own(receivers, course, progress);
      if (!lit) return lit;
      return bothLit(**standing, *lit);
    };
    auto findings = detail::judge(rule_, {now, before_}, targets_, conventions_, {});
    if (!findings) return tl::unexpected(findings.error());
    if (baseline_ == nullptr || !detail::allPass(*findings)) return detail::allPass(*findings);
    const auto held = detail::holdOutlines(withColumns(stands_, columns, options_.base), *baseline_, rule_, targets_,
                                           conventions_, {}, *findings);
    if (!held) return tl::unexpected(held.error());
    return detail::allPass(*findings);
  }

  const scene::Scene& stands_;
  const scene::Scene* baseline_;
  const Rule& rule_;
  const TargetSet& targets_;
  const VerifyRequest& request_;
  const detail::Conventions conventions_ = detail::conventionsOf(rule_, request_);
  const InverseOptions& options_;
  SunOf before_;
  Standing standing_;
  std::vector<Column> columns_;
  const ProgressSink& progress_;
  scene::Scene frame_;  // the scene's axes and unit without anything in it
  std::size_t trials_ = 0;
};

}  // namespace

Result<InverseEnvelope> inverseEnvelope(const scene::Scene& scene, const scene::Scene* baseline, const Rule& rule,
                                        const TargetSet& targets, const Area& site, const VerifyRequest& request,
                                        const InverseOptions& options, const ProgressSink& progress) {
  if (const auto fine = detail::checkRequest(rule, baseline != nullptr, targets, request); !fine)
    return tl::unexpected(fine.error());
  if (!(options.most > 0.0)) return fail(ErrorCode::usage, "the volume has no height to grow to");
  if (site.region.polygons.empty()) return fail(ErrorCode::usage, "the site has no area");
  auto columns = columnsOf(site, scene, options);
  if (!columns) return tl::unexpected(columns.error());
  scene::Scene stands = scene;
  if (rule.casters == CastersOf::site)
    for (scene::Instance& instance : stands.instances) instance.casts = false;
  Lights lights;
  for (const auto& [of, light] :
       {std::pair<const scene::Scene*, SunOf*>(&stands, &lights.now), {baseline, &lights.before}}) {
    if (of == nullptr) continue;
    auto hours = study::ExactHours::build(*of, request.place);
    if (!hours) return tl::unexpected(hours.error());
    *light = detail::sunOf(std::make_shared<const study::ExactHours>(std::move(*hours)));
  }
  Grower grower(stands, baseline, rule, targets, request, options, std::move(lights), std::move(*columns), progress);
  if (const auto grown = grower.run(); !grown) return tl::unexpected(grown.error());
  InverseEnvelope out;
  out.trials = grower.trials();
  out.columns = grower.take();
  // What stands and the volume were solved apart while it grew; together a moment may differ by a fraction of a second.
  for (int i = 0; i < kTries; ++i) {
    out.scene = withColumns(stands, out.columns, options.base);
    auto verdict = verify(out.scene, baseline, rule, targets, request);
    if (!verdict) return tl::unexpected(verdict.error());
    out.verdict = std::move(*verdict);
    if (out.verdict.passes) break;
    for (Column& column : out.columns)
      if (column.bounded) column.height *= 1.0 - kFine;
  }
  for (const Column& column : out.columns)
    out.volume += column.plan.area * scene.metresPerUnit * scene.metresPerUnit * column.height;
  return out;
}

}  // namespace umbrage::rules
