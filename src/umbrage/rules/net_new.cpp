#include "umbrage/rules/net_new.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "umbrage/outline/combine.hpp"
#include "umbrage/rules/detail/days.hpp"
#include "umbrage/study/sun_light.hpp"

namespace umbrage::rules {
namespace {

using detail::Spans;
using outline::CasterPart;
using outline::Region;
using std::chrono::milliseconds;
using study::TimeSpan;

constexpr milliseconds kBorder{50};  // how closely a visit's ends are found
constexpr int kDeepest = 14;         // halvings of Simpson's rule
constexpr double kIntegral = 1e-6;
constexpr std::size_t kMostCorners = 128;  // of a piece of an area

bool same(const CasterPart& a, const CasterPart& b) {
  return a.name == b.name && a.points == b.points && a.triangles == b.triangles;
}

std::vector<CasterPart> addedTo(const std::vector<CasterPart>& proposal, const std::vector<CasterPart>& baseline) {
  std::vector<CasterPart> added;
  for (const CasterPart& part : proposal)
    if (std::none_of(baseline.begin(), baseline.end(), [&](const CasterPart& other) { return same(part, other); }))
      added.push_back(part);
  return added;
}

// The new shadow on one area (or on all) over time.
class Ground {
 public:
  Ground(const std::vector<CasterPart>& added, const std::vector<CasterPart>& standing, const study::SunCourse& course,
         Angle north, std::optional<Region> within)
      : added_(added), standing_(standing), course_(course), north_(north), within_(std::move(within)) {}

  [[nodiscard]] Region at(sun::Instant t) const { return outline::newShadow(added_, standing_, slope(t), within_); }
  [[nodiscard]] Region at(sun::Instant t, std::size_t building) const {
    return outline::newShadow({added_[building]}, standing_, slope(t), within_);
  }
  /// Thousands of areas are asked for over a day: a piece with few corners is clipped in far less than its share of the time.
  void cutIntoPieces() {
    if (within_) pieces_ = outline::inPieces(*within_, kMostCorners);
  }
  [[nodiscard]] double areaAt(sun::Instant t) const {
    return pieces_.empty() ? at(t).area : outline::newShadowArea(added_, standing_, slope(t), pieces_);
  }
  [[nodiscard]] double areaAt(sun::Instant t, std::size_t building) const {
    return pieces_.empty() ? at(t, building).area
                           : outline::newShadowArea({added_[building]}, standing_, slope(t), pieces_);
  }
  [[nodiscard]] const std::vector<CasterPart>& added() const { return added_; }

 private:
  [[nodiscard]] Vec2 slope(sun::Instant t) const {
    const Vec3 s = course_.towards(t);
    const Vec3 towards = s.x * scene::eastVector(scene::UpAxis::z, north_) +
                         s.y * scene::northVector(scene::UpAxis::z, north_) + Vec3(0.0, 0.0, s.z);
    return -Vec2(towards) / towards.z;
  }

  const std::vector<CasterPart>& added_;
  const std::vector<CasterPart>& standing_;
  const study::SunCourse& course_;
  Angle north_;
  std::optional<Region> within_;
  std::vector<Region> pieces_;
};

using AreaAt = std::function<double(sun::Instant)>;

// The moment between a and b at which there begins, or ceases, to be any.
sun::Instant change(const AreaAt& area, sun::Instant a, sun::Instant b, bool anyAtA) {
  while (b - a > kBorder) {
    const sun::Instant middle = a + (b - a) / 2;
    ((area(middle) > 0.0) == anyAtA ? a : b) = middle;
  }
  return a + (b - a) / 2;
}

std::vector<Visit> visitsOf(const std::string& building, const AreaAt& area, const Spans& times, double square) {
  std::vector<Visit> visits;
  for (const TimeSpan& span : times) {
    const auto looks = std::max<std::int64_t>(1, (span.length() + kLook - milliseconds(1)) / kLook);
    const auto look = [&](std::int64_t i) { return span.from + span.length() * i / looks; };
    std::optional<Visit> open;
    double before = 0.0;
    for (std::int64_t i = 0; i <= looks; ++i) {
      // The last moment no longer belongs to the span.
      const sun::Instant t = i == looks ? span.to - milliseconds(1) : look(i);
      const double size = area(t);
      if (size > 0.0 && !open)
        open = Visit{building, {i == 0 ? span.from : change(area, look(i - 1), t, false), span.to}, 0.0, t};
      if (size > 0.0 && size * square > open->most) open->most = size * square, open->mostAt = t;
      if (size == 0.0 && open) {
        if (before > 0.0) open->span.to = change(area, look(i - 1), t, true);
        visits.push_back(*open);
        open.reset();
      }
      before = size;
    }
    if (open) visits.push_back(*open);
  }
  return visits;
}

// Simpson's rule, halved where it is not yet right. Times in hours.
double simpson(const AreaAt& area, sun::Instant a, sun::Instant b, double fa, double fm, double fb, double tolerance,
               int depth) {
  const double width = detail::hoursOf(b - a);
  const sun::Instant middle = a + (b - a) / 2;
  const double whole = width / 6.0 * (fa + 4.0 * fm + fb);
  const double fl = area(a + (middle - a) / 2), fr = area(middle + (b - middle) / 2);
  const double halves = width / 12.0 * (fa + 4.0 * fl + 2.0 * fm + 4.0 * fr + fb);
  if (depth <= 0 || std::abs(halves - whole) <= 15.0 * tolerance || b - a < milliseconds(200))
    return halves + (halves - whole) / 15.0;
  return simpson(area, a, middle, fa, fl, fm, 0.5 * tolerance, depth - 1) +
         simpson(area, middle, b, fm, fr, fb, 0.5 * tolerance, depth - 1);
}

// Over the visits, whose ends are where the area is not smooth.
double integral(const AreaAt& area, const std::vector<Visit>& visits) {
  double rough = 0.0;
  for (const Visit& visit : visits) rough += visit.most * detail::hoursOf(visit.span.length());
  double sum = 0.0;
  for (const Visit& visit : visits) {
    const sun::Instant from = visit.span.from, to = visit.span.to - milliseconds(1);
    if (from >= to) continue;
    constexpr int kParts = 8;
    for (int i = 0; i < kParts; ++i) {
      const sun::Instant a = from + (to - from) * i / kParts, b = from + (to - from) * (i + 1) / kParts;
      sum += simpson(area, a, b, area(a), area(a + (b - a) / 2), area(b),
                     kIntegral * rough / (kParts * double(visits.size())), kDeepest);
    }
  }
  return sum;
}

Spans highEnough(const study::SunCourse& course, const NetNewOptions& options) {
  return detail::both(options.times, detail::countingTimes(course, options.leastElevation));
}

AreaNews newsOf(const std::string& name, double size, const Ground& ground, const Spans& times, double square,
                bool byBuilding) {
  AreaNews news{name, size, 0.0, {}, {}};
  const AreaAt all = [&](sun::Instant t) { return ground.areaAt(t); };
  news.all = visitsOf("", all, times, square);
  news.areaHours = integral([&](sun::Instant t) { return all(t) * square; }, news.all);
  if (news.all.empty() || !byBuilding) return news;
  if (ground.added().size() == 1) {
    news.visits = news.all;
    for (Visit& visit : news.visits) visit.building = ground.added().front().name;
    return news;
  }
  Spans during;
  for (const Visit& visit : news.all) during.push_back(visit.span);
  for (std::size_t b = 0; b < ground.added().size(); ++b) {
    const AreaAt own = [&](sun::Instant t) { return ground.areaAt(t, b); };
    for (Visit& visit : visitsOf(ground.added()[b].name, own, during, square)) news.visits.push_back(std::move(visit));
  }
  std::stable_sort(news.visits.begin(), news.visits.end(),
                   [](const Visit& a, const Visit& b) { return a.span.from < b.span.from; });
  return news;
}

NewShadow momentOf(sun::Instant at, const Ground& ground) {
  NewShadow moment{at, ground.at(at), {}};
  for (std::size_t b = 0; b < ground.added().size(); ++b)
    if (Region own = ground.at(at, b); !own.polygons.empty())
      moment.byBuilding.push_back({ground.added()[b].name, std::move(own)});
  return moment;
}

// The instances of one building alone.
scene::Scene onlyOf(scene::Scene scene, const std::string& building) {
  for (scene::Instance& i : scene.instances) i.casts = i.casts && (i.group.empty() ? i.name : i.group) == building;
  return scene;
}

std::chrono::year_month_day nearestTo(std::chrono::sys_days day,
                                      const std::vector<std::chrono::year_month_day>& dates) {
  const auto off = [&](const auto& date) { return std::chrono::abs(std::chrono::sys_days(date) - day); };
  return *std::min_element(dates.begin(), dates.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });
}

}  // namespace

Result<std::vector<AreaNews>> newOnPoints(const scene::Scene& proposal, const scene::Scene& baseline,
                                          const sun::Place& place, const study::ReceiverSet& points,
                                          const std::vector<TimeSpan>& times, const study::SunModel& sun,
                                          const ProgressSink& progress) {
  const auto added = addedTo(outline::castersOf(proposal), outline::castersOf(baseline));
  if (added.empty())
    return fail(ErrorCode::usage, "the scene has nothing that casts and that the baseline has not", proposal.source);
  std::vector<AreaNews> news(points.receivers.size());
  for (std::size_t i = 0; i < news.size(); ++i) news[i].area = "point " + std::to_string(i + 1);
  if (times.empty()) return news;
  const auto course = study::SunCourse::make(place, {times.front().from, times.back().to}, sun);
  const auto litBy = [&](const scene::Scene& scene) -> Result<study::SunHours> {
    const auto hours = study::ExactHours::build(scene, place);
    if (!hours) return tl::unexpected(hours.error());
    return hours->at(points.receivers, course, progress);
  };
  const auto before = litBy(baseline);
  if (!before) return tl::unexpected(before.error());
  std::vector<Spans> all(news.size());
  for (const CasterPart& part : added) {
    const auto lit = litBy(onlyOf(proposal, part.name));
    if (!lit) return tl::unexpected(lit.error());
    for (std::size_t i = 0; i < news.size(); ++i)
      for (const TimeSpan& span :
           detail::atLeast(detail::without(detail::both(times, before->lit(i)), lit->lit(i)), kShortestNew)) {
        news[i].visits.push_back({part.name, span, 0.0, span.from});
        all[i].push_back(span);
      }
  }
  for (std::size_t i = 0; i < news.size(); ++i) {
    std::stable_sort(news[i].visits.begin(), news[i].visits.end(),
                     [](const Visit& a, const Visit& b) { return a.span.from < b.span.from; });
    for (const TimeSpan& span : detail::joined(all[i])) news[i].all.push_back({"", span, 0.0, span.from});
    news[i].areaHours = detail::hoursOf(detail::total(detail::joined(all[i])));
  }
  return news;
}

std::vector<std::chrono::year_month_day> newsDates(const Verdict& verdict, const VerifyRequest& request) {
  using std::chrono::year_month_day;
  const Deciding deciding = decidingOf(verdict);
  const std::size_t requirement = verdict.findings[deciding.finding].requirement;
  const std::vector<year_month_day> all =
      datesOf(verdict.rule.requirements[requirement].anyOf[deciding.measure], request);
  if (all.size() <= kMostNewsDays) return all;
  std::set<year_month_day> chosen;
  if (deciding.date) chosen.insert(*deciding.date);
  for (const Finding& f : verdict.findings) {
    if (!f.deciding || f.requirement != requirement || chosen.size() == kMostNewsDays) continue;
    const ReceiverResult& r = f.receivers[*f.deciding];
    if (r.measure == deciding.measure) chosen.insert(f.outlines ? f.outlines->date : r.date);
  }
  if (verdict.rule.requirements[requirement].mostNew)
    for (const Angle longitude : {Angle{}, Angle::degrees(90), Angle::degrees(180), Angle::degrees(270)})
      chosen.insert(nearestTo(
          sun::clockAt(request.zone, request.place, detail::instantOfLongitude(longitude, request.date.year()))
              .clock.date,
          all));
  return {chosen.begin(), chosen.end()};
}

Result<NetNew> netNew(const scene::Scene& proposal, const scene::Scene& baseline, const sun::Place& place,
                      const NetNewOptions& options, const ProgressSink& progress) {
  const auto standing = outline::aboveHeight(outline::castersOf(baseline), options.height);
  const auto added = addedTo(outline::aboveHeight(outline::castersOf(proposal), options.height), standing);
  if (added.empty())
    return fail(ErrorCode::usage, "the scene has nothing that casts and that the baseline has not", proposal.source);
  NetNew out;
  for (const CasterPart& part : added) out.added.push_back(part.name);
  if (options.times.empty()) return out;
  const TimeSpan whole{options.times.front().from, options.times.back().to};
  const auto course = study::SunCourse::make(place, whole, options.sun);
  const Spans times = highEnough(course, options);
  const double square = proposal.metresPerUnit * proposal.metresPerUnit;
  std::optional<Region> within;
  if (!options.areas.empty()) {
    std::vector<Region> regions;
    for (const Area& area : options.areas) regions.push_back(area.region);
    within = outline::together(regions);
  }
  const Ground everywhere(added, standing, course, proposal.northOffset, within);
  for (const sun::Instant at : options.moments)
    if (course.towards(at).z > 0.0) out.moments.push_back(momentOf(at, everywhere));
  if (options.areas.empty()) out.areas.push_back(newsOf("plane", 0.0, everywhere, times, square, options.byBuilding));
  for (std::size_t i = 0; i < options.areas.size(); ++i) {
    if (!reportProgress(progress, double(i) / double(options.areas.size()), "new shadow"))
      return fail(ErrorCode::cancelled, "cancelled");
    const Area& area = options.areas[i];
    Ground ground(added, standing, course, proposal.northOffset, area.region);
    ground.cutIntoPieces();
    out.areas.push_back(newsOf(area.name, area.region.area * square, ground, times, square, options.byBuilding));
  }
  return out;
}

}  // namespace umbrage::rules
