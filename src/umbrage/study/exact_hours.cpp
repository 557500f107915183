#include "umbrage/study/exact_hours.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <thread>

#include "umbrage/base/check.hpp"
#include "umbrage/study/detail/coverage_rooms.hpp"
#include "umbrage/study/detail/hours_build.hpp"
#include "umbrage/study/detail/hours_groups.hpp"
#include "umbrage/study/detail/hours_solve.hpp"
#include "umbrage/study/detail/sun_leg.hpp"

namespace umbrage::study {

using detail::ArcDirections;
using detail::Coverage;
using detail::CoverJob;
using detail::SunLeg;
using std::chrono::milliseconds;

struct ExactHours::Impl {
  detail::SkyFrame frame;
  sun::Place place;
  Vec3 origin{0.0};
  detail::HoursTree tree;
  detail::SolidBoxes boxes;
  std::vector<detail::Casters::Solid> solids;
  ExactHoursOptions options;
  double contact = 0.0;
};

namespace {

// Gaps of light or shade shorter than this are what rounding leaves between neighbours.
constexpr double kShortest = 0.1;  // seconds

detail::SkyFrame frameOf(const scene::Scene& scene, const sun::Place& place) {
  detail::SkyFrame f;
  f.east = scene::eastVector(scene.up, scene.northOffset);
  f.north = scene::northVector(scene.up, scene.northOffset);
  f.up = scene::upVector(scene.up);
  f.sinLatitude = sin(place.latitude), f.cosLatitude = cos(place.latitude);
  f.first = f.cosLatitude * f.up - f.sinLatitude * f.north;
  f.west = -f.east;
  f.south = -f.cosLatitude * f.north - f.sinLatitude * f.up;
  return f;
}

bool useWide(bool asked) {
#ifdef UMBRAGE_HOURS_WIDE
  static const bool has = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  return asked && has;
#else
  return asked && false;
#endif
}

// ---- a leg, made ready for the traversal

struct ReadyLeg {
  const SunLeg* leg;
  std::vector<ArcDirections> arcs;

  ReadyLeg(const SunLeg& l, const detail::SkyFrame& f) : leg(&l), arcs(l.arcs.size()) {
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      const detail::SunArc& a = l.arcs[i];
      const Vec3 rise = a.rise * f.south, cosine = f.first + a.cosine * f.south, sine = f.west + a.sine * f.south;
      for (int k = 0; k < 3; ++k)
        arcs[i].rise[k] = float(rise[k]), arcs[i].cosine[k] = float(cosine[k]), arcs[i].sine[k] = float(sine[k]);
      arcs[i].low = float(a.low), arcs[i].high = float(a.high);
    }
  }
};

// ---- what the traversal asks back, in double precision

struct GroupContext {
  const ExactHours::Impl& hours;
  const SunLeg& leg;
  const Vec3* positions;  // relative to the origin, by number in the group
  const Vec3* normals;    // unit or 0
  bool bothSides =
      false;  // a point touches a closed solid, and not with its face before it: the faces towards it do not tell all

  struct Seen {
    Vec3 corner[4];
    Vec3 area;
  };
  [[nodiscard]] Seen see(std::uint32_t point, std::uint32_t quad) const {
    const detail::TreeQuad& q = hours.tree.quads[quad];
    Seen s;
    for (int k = 0; k < 4; ++k) s.corner[k] = Vec3(q.x[k], q.y[k], q.z[k]) - positions[point];
    s.area = glm::cross(s.corner[2] - s.corner[0], s.corner[3] - s.corner[0]) +
             glm::cross(s.corner[1] - s.corner[0], s.corner[2] - s.corner[0]);
    return s;
  }

  // Which side of a quad the eye sees: -1 the one about which its corners are counter-clockwise.
  [[nodiscard]] static double seenSide(const Seen& s) { return glm::dot(s.area, s.corner[0]) < 0.0 ? -1.0 : 1.0; }

  // Through edge k and the eye, its normal to the inner side; 0 for an edge without length.
  [[nodiscard]] Vec3 side(const Seen& s, int k, double seen) const {
    const Vec3 &a = s.corner[k], &b = s.corner[(k + 1) & 3];
    if (a == b) return Vec3(0.0);
    return hours.frame.turning(glm::cross(a, b) * seen);
  }
};

bool refineEdges(void* context, std::uint32_t point, std::uint32_t quad, std::uint32_t lanes, std::uint32_t arc,
                 float first, float last, float* from, float* to) {
  const auto& group = *static_cast<const GroupContext*>(context);
  const GroupContext::Seen seen = group.see(point, quad);
  for (; lanes != 0; lanes &= lanes - 1) {
    const int k = std::countr_zero(lanes);
    if (!detail::hoursInside(group.leg, group.leg.arcs[arc], group.side(seen, k, GroupContext::seenSide(seen)), first,
                             last, from[k], to[k]))
      return false;
  }
  return true;
}

// Whether the foot of the eye on the quad's plane lies on the quad, or nearer to it than `margin`.
bool standsOn(const GroupContext::Seen& s, const Vec3& unit, double margin) {
  for (int k = 0; k < 4; ++k) {
    const Vec3 &a = s.corner[k], edge = s.corner[(k + 1) & 3] - a;
    if (glm::dot(glm::cross(edge, -a), unit) < -margin * glm::length(edge)) return false;
  }
  return true;
}

detail::Stretches overlap(const detail::Stretches& a, const detail::Stretches& b) {
  detail::Stretches out;
  for (const auto& x : a)
    for (const auto& y : b)
      if (std::max(x.first, y.first) < std::min(x.second, y.second))
        out.emplace_back(std::max(x.first, y.first), std::min(x.second, y.second));
  return out;
}

// The foot of the eye on the quad's plane; where it is as near to a corner or an edge as may be rounding, that corner or the edge. So each of
// the faces that meet there hides what lies on its own side, and no more and no less. Corners may lie off the plane by rounding, so nearness
// is measured along it.
Vec3 footOn(const GroupContext::Seen& s, const Vec3& unit, double margin) {
  const auto flat = [&](const Vec3& v) { return v - unit * glm::dot(unit, v); };
  for (const Vec3& corner : s.corner)
    if (glm::length(flat(corner)) <= margin) return corner;
  for (int k = 0; k < 4; ++k) {
    const Vec3 &a = s.corner[k], edge = s.corner[(k + 1) & 3] - a;
    const Vec3 from = flat(a), along = flat(edge);
    const double length2 = glm::dot(along, along);
    if (!(length2 > 0.0)) continue;
    const Vec3 onEdge = a - (glm::dot(from, along) / length2) * edge;
    if (glm::length(flat(onEdge)) <= margin) return onEdge;
  }
  return unit * glm::dot(unit, s.corner[0]);
}

bool touchQuad(void* context, std::uint32_t point, std::uint32_t quad, bool closed, Coverage& covered) {
  auto& group = *static_cast<GroupContext*>(context);
  GroupContext::Seen seen = group.see(point, quad);
  const Vec3 unit = glm::normalize(seen.area);
  const double depth = glm::dot(unit, seen.corner[0]);
  if (std::abs(depth) > group.hours.contact || !standsOn(seen, unit, group.hours.contact)) return false;
  // The sine between the surface and the way the receiver faces below which that way tells no side: of a closed solid, of which nobody is inside
  // who does not say so, and of a sheet.
  constexpr double kUpright = 0.05, kEdgeOn = 1e-3;
  const double facing = glm::dot(unit, group.normals[point]), nothing = 1e-11 * group.hours.tree.reach;
  if (!closed && std::abs(facing) < kEdgeOn) return group.normals[point] == Vec3(0.0) || std::abs(depth) <= nothing;
  const bool upright = closed && std::abs(facing) < kUpright;
  const double above = upright ? 1.0 : facing;
  group.bothSides = group.bothSides || upright || (closed && above < 0.0);
  // Seen from where the eye is, if that is on the right side by more than rounding; else from just off the surface the way the receiver faces, so
  // that all faces that meet in a point are seen from one place: between two that meet at a sharp angle nothing is missed then.
  const double rounding = 0.25 * group.hours.contact;
  const Vec3 foot = footOn(seen, unit, rounding);
  const double below = glm::dot(unit, foot);  // how far the eye is below the surface there
  const bool stays = below * above < 0.0 && (upright ? std::abs(below) > nothing : glm::length(foot) > rounding);
  const Vec3 eye = stays ? Vec3(0.0) : foot + nothing * (upright ? unit : group.normals[point]);
  for (Vec3& corner : seen.corner) corner -= eye;
  detail::Stretches dark{{group.leg.first, group.leg.last}};
  for (int k = 0; k < 4 && !dark.empty(); ++k) {
    const Vec3 side = group.side(seen, k, above > 0.0 ? -1.0 : 1.0);  // told, since rounding may bend the quad
    if (side != Vec3(0.0)) dark = overlap(dark, detail::stretchesInside(group.leg, side));
  }
  for (const auto& [from, to] : dark) detail::addPlain(covered, float(from), float(to), detail::growCoverage);
  return true;
}

// ---- one group over one leg

class Worker {
 public:
  Worker(const ExactHours::Impl& hours, std::span<const ReadyLeg> legs, const SunCourse& course)
      : hours_(hours), legs_(legs), course_(course), wide_(useWide(hours.options.wide)) {}

  // Appends what lights each of the group's receivers.
  void light(std::span<const Receiver> receivers, std::span<const std::uint32_t> members,
             std::array<std::vector<TimeSpan>, detail::kGroup>& lit) {
    detail::useRooms(rooms_);
    Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
    CoverJob job{};
    box_ = {};
    job.count = static_cast<std::int32_t>(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
      positions_[i] = receivers[members[i]].position - hours_.origin;
      for (int k = 0; k < 3; ++k) {
        job.points[i].high[k] = float(positions_[i][k]);
        job.points[i].low[k] = float(positions_[i][k] - double(job.points[i].high[k]));
      }
      job.points[i].index = static_cast<std::uint32_t>(i);
      box_.add(positions_[i]);
      const Vec3 p = hours_.frame.horizontal(positions_[i]);
      low = glm::min(low, p), high = glm::max(high, p);
      const Vec3 turning = hours_.frame.turning(positions_[i]);
      job.eyeFirst[i] = float(turning.x), job.eyeWest[i] = float(turning.y), job.eyeSouth[i] = float(turning.z);
      lit[i].clear();
      const Vec3& given = receivers[members[i]].normal;
      const double length = glm::length(given);
      normals_[i] = length > 0.0 ? given / length : Vec3(0.0);
    }
    place(job, low, high);
    for (const ReadyLeg& leg : legs_) pass(job, leg, lit);
  }

 private:
  void place(CoverJob& job, const Vec3& low, const Vec3& high) {
    const Vec3 middle = 0.5 * (low + high), far = glm::max(glm::abs(low), glm::abs(high));
    const double margin = 0x1p-21 * std::max({far.x, far.y, far.z});  // of rounding the middle
    job.margin = float(margin);
    const Vec3 half = 0.5 * (high - low) + Vec3(margin);
    const detail::SkyFrame& f = hours_.frame;
    const Vec3 turning = f.turning(middle.x * f.east + middle.y * f.north + middle.z * f.up);
    for (int k = 0; k < 3; ++k) job.middle[k] = float(turning[k]), job.extent[k] = float(half[k]);
    face(job);
    within_.clear();
    hours_.boxes.find(box_.min - Vec3(2.0 * hours_.contact), box_.max + Vec3(2.0 * hours_.contact), within_);
    std::erase_if(within_, [&](std::int32_t solid) { return allOutside(solid, job.count); });
    job.within = within_.data(), job.withinCount = static_cast<std::int32_t>(within_.size());
    job.nodes = hours_.tree.nodes.data(), job.leaves = hours_.tree.leaves.data(), job.quads = hours_.tree.quads.data();
    job.root = hours_.tree.root;
    job.ballNodes = hours_.tree.ballNodes.empty() ? nullptr : hours_.tree.ballNodes.data();
    job.balls = hours_.tree.balls.data(), job.ballRoot = hours_.tree.ballRoot;
    job.sinLatitude = float(f.sinLatitude), job.cosLatitude = float(f.cosLatitude);
    job.contact = float(hours_.contact);
    job.grow = detail::growCoverage, job.refine = refineEdges, job.touch = touchQuad;
  }

  // The ways the points face, for leaving out what is behind all of them.
  void face(CoverJob& job) const {
    for (int i = 0; i < job.count; ++i) {
      const Vec3& n = normals_[static_cast<std::size_t>(i)];
      const Vec3 normal = hours_.frame.turning(n), slab = glm::abs(hours_.frame.horizontal(n)) * 1.000001;
      for (int k = 0; k < 3; ++k) job.facing[k][i] = float(normal[k]), job.facing[3 + k][i] = float(slab[k]);
      job.spread = std::max(job.spread, float(1.000001 * glm::distance(n, normals_[0])));
    }
    for (int k = 0; k < 6; ++k) job.normal[k] = job.facing[k][0];
  }

  // Whether each of the group's points has a side of a convex solid before it, or touches one that faces as it does.
  [[nodiscard]] bool allOutside(std::int32_t solid, std::int32_t count) const {
    const auto& sides = hours_.solids[static_cast<std::size_t>(solid)].sides;
    const auto outside = [&](std::size_t i) {
      return std::any_of(sides.begin(), sides.end(), [&](const detail::Casters::Plane& side) {
        const double before = glm::dot(positions_[i] - side.point, side.normal);
        return before > hours_.contact ||
               (before >= -hours_.contact && glm::dot(side.normal, normals_[i]) >= 1.0 - 1e-9);
      });
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
      if (!outside(i)) return false;
    return true;
  }

  // The hours in which the sun is behind a receiver's own plane.
  void coverBehind(const SunLeg& leg, const Vec3& normal, Coverage& covered) const {
    if (normal == Vec3(0.0)) return;
    double dark = leg.first;
    const auto cover = [&](double to) {
      if (dark < to) detail::addPlain(covered, float(dark), float(to), detail::growCoverage);
    };
    for (const auto& [from, to] : detail::stretchesInside(leg, hours_.frame.turning(normal))) {
      cover(from);
      dark = to;
    }
    cover(leg.last);
  }

  static void copyStart(const Coverage& from, Coverage& to) {
    std::copy_n(from.from, 8, to.from);
    std::copy_n(from.to, 8, to.to);
    to.count = from.count, to.bins = from.bins;
  }

  void pass(CoverJob& job, const ReadyLeg& ready, std::array<std::vector<TimeSpan>, detail::kGroup>& lit) {
    const SunLeg& leg = *ready.leg;
    GroupContext context{hours_, leg, positions_.data(), normals_.data()};
    job.rise = float(leg.whole.rise), job.cosine = float(leg.whole.cosine), job.sine = float(leg.whole.sine);
    job.error = float(leg.wholeError);
    job.longest = float(std::hypot(1.0, std::abs(leg.middleHeight) + 0.5 * leg.heightRange) * (1.0 + 1e-6));
    job.first = float(leg.first), job.last = float(leg.last);
    job.arcs = ready.arcs.data(), job.arcCount = static_cast<std::int32_t>(ready.arcs.size());
    job.context = &context;
    // Who is outside is hidden by the faces towards him alone. Few are inside, so all are taken to be outside first.
    job.inside = false;
    traverse(job, leg);
    if (job.withinCount > 0 && (context.bothSides || anyInside(job, leg))) {
      job.inside = true;
      traverse(job, leg);
    }
    for (int i = 0; i < job.count; ++i) addGaps(leg, job.covered[i], lit[static_cast<std::size_t>(i)]);
  }

  void traverse(CoverJob& job, const SunLeg& leg) {
    Coverage start{};
    for (int i = 0; i < job.count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      job.covered[i] = detail::emptyCoverage(rooms_.rooms[k], leg);
      if (i > 0 && normals_[k] == normals_[0] && start.count < 8)
        copyStart(start, job.covered[i]);
      else
        coverBehind(leg, normals_[k], job.covered[i]);
      if (i == 0) start = job.covered[0];
    }
    cover(job);
  }

  void cover(CoverJob& job) const {
    if (!hours_.tree.nodes.empty()) wide_ ? detail::coverWide(job) : detail::coverPlain(job);
  }

  // Whether a point may lie inside a closed solid, after a traversal that took all to be outside: then the sun in the middle of what it
  // left lit meets an averted face. From outside it meets none, since it would meet a face towards the point before.
  bool anyInside(const CoverJob& job, const SunLeg& leg) {
    constexpr float kHalf = 1e-4f, kLeast = 4e-5f;  // of what is probed, and the least stretch that can be; 0.9 s
    CoverJob probe = job;
    probe.inside = true;
    std::uint32_t open = 0;
    for (int i = 0; i < job.count; ++i) {
      const auto [from, to] = detail::longestGap(job.covered[i], float(leg.first), float(leg.last));
      if (from < to && to - from < kLeast) return true;
      const float middle = 0.5f * (from + to), half = std::min(kHalf, 0.25f * (to - from));
      probe.covered[i] = detail::emptyCoverage(rooms_.probes[static_cast<std::size_t>(i)], leg);
      if (from < to) {
        open |= 1u << i;
        detail::addPlain(probe.covered[i], float(leg.first), middle - half, detail::growCoverage);
        detail::addPlain(probe.covered[i], middle + half, float(leg.last), detail::growCoverage);
      } else {
        detail::addPlain(probe.covered[i], float(leg.first), float(leg.last), detail::growCoverage);
      }
    }
    if (open == 0) return false;
    cover(probe);
    for (int i = 0; i < job.count; ++i)
      if ((open >> i & 1u) != 0 && probe.covered[i].count == 1) return true;
    return false;
  }

  void addGaps(const SunLeg& leg, const Coverage& covered, std::vector<TimeSpan>& lit) const {
    float from = float(leg.first);
    double fromTime = leg.firstTime;
    const auto last = float(leg.last);
    const auto time = [&](float p) { return leg.timeAt(double(p)); };
    for (std::int32_t i = 0; i <= covered.count; ++i) {
      const bool end = i == covered.count;
      const float to = end ? last : std::min(covered.from[i], last);
      if (to > from) append(fromTime, end || to >= last ? leg.lastTime : time(to), lit);
      if (end || covered.to[i] >= last) return;
      from = std::max(from, covered.to[i]);
      fromTime = time(from);
    }
  }

  void append(double from, double to, std::vector<TimeSpan>& lit) const {
    if (to - from < kShortest) return;
    const auto instant = [&](double t) { return course_.span().from + milliseconds(std::llround(t * 1000.0)); };
    const TimeSpan span{instant(from), instant(to)};
    if (!lit.empty() && span.from - lit.back().to <= milliseconds(1)) {
      lit.back().to = span.to;  // the sun passed under the pole
      return;
    }
    lit.push_back(span);
  }

  const ExactHours::Impl& hours_;
  std::span<const ReadyLeg> legs_;
  const SunCourse& course_;
  bool wide_;
  detail::CoverageRooms rooms_;
  std::array<Vec3, detail::kGroup> positions_;
  std::vector<std::int32_t> within_;
  std::array<Vec3, detail::kGroup> normals_;
  Box3 box_;  // of the group
};

// What each thread found, until all of it is put in order.
struct Found {
  std::vector<TimeSpan> lit;
};
struct Where {
  std::uint32_t thread = 0, count = 0;
  std::size_t begin = 0;
};

SunHours inOrder(const std::vector<Where>& where, const std::vector<Found>& found) {
  std::vector<std::size_t> begin(where.size() + 1, 0);
  for (std::size_t i = 0; i < where.size(); ++i) begin[i + 1] = begin[i] + where[i].count;
  std::vector<TimeSpan> lit(begin.back());
  for (std::size_t i = 0; i < where.size(); ++i)
    std::copy_n(found[where[i].thread].lit.begin() + static_cast<std::ptrdiff_t>(where[i].begin), where[i].count,
                lit.begin() + static_cast<std::ptrdiff_t>(begin[i]));
  return {std::move(begin), std::move(lit)};
}

}  // namespace

// ---- ExactHours

ExactHours::ExactHours(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
ExactHours::ExactHours(ExactHours&&) noexcept = default;
ExactHours& ExactHours::operator=(ExactHours&&) noexcept = default;
ExactHours::~ExactHours() = default;

Result<ExactHours> ExactHours::build(const scene::Scene& scene, const sun::Place& place,
                                     const ExactHoursOptions& options) {
  const scene::Surfaces surfaces = scene::flatten(scene);
  auto impl = std::make_unique<Impl>();
  impl->frame = frameOf(scene, place);
  impl->place = place;
  impl->origin = surfaces.origin;
  impl->options = options;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t)
    if (surfaces.casts[t] != 0 && scene.materials[surfaces.materials[t]].opacity >= options.leastOpacity)
      chosen.push_back(t);
  detail::Casters casters = detail::makeCasters(surfaces, chosen);
  impl->tree = detail::buildTree(surfaces, casters, impl->frame);
  impl->contact = kContact * impl->tree.reach;
  std::vector<Box3> boxes;
  for (const auto& solid : casters.solids) boxes.push_back(solid.box);
  impl->boxes = detail::SolidBoxes(std::move(boxes));
  impl->solids = std::move(casters.solids);
  return ExactHours(std::move(impl));
}

Result<SunHours> ExactHours::at(std::span<const Receiver> receivers, const SunCourse& course,
                                const ProgressSink& progress) const {
  UMBRAGE_CHECK(course.place().latitude == impl_->place.latitude, "the course is of another place");
  // Once for certain: on a busy machine the other threads may leave this one nothing to do and to report.
  if (!reportProgress(progress, 0.0, "sun hours")) return fail(ErrorCode::cancelled, "cancelled");
  std::vector<ReadyLeg> legs;
  for (const SunLeg& leg : course.legs()) legs.emplace_back(leg, impl_->frame);
  const detail::Groups groups = detail::makeGroups(receivers, 1.4 * impl_->tree.leafSize);

  constexpr std::size_t kPerTurn = 64;
  const std::size_t turns = (groups.size() + kPerTurn - 1) / kPerTurn;
  const unsigned wanted =
      impl_->options.threads > 0 ? impl_->options.threads : std::max(1u, std::thread::hardware_concurrency());
  const auto threads = static_cast<unsigned>(std::clamp<std::size_t>(turns, 1, wanted));
  std::vector<Found> found(threads);
  std::vector<Where> where(receivers.size());
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  const auto work = [&](std::uint32_t thread, const auto& afterTurn) {
    Worker worker(*impl_, legs, course);
    std::array<std::vector<TimeSpan>, detail::kGroup> lit;
    for (std::size_t turn; !stop && (turn = next++) < turns;) {
      for (std::size_t g = turn * kPerTurn; g < std::min(groups.size(), (turn + 1) * kPerTurn); ++g) {
        const auto members = groups.members(g);
        worker.light(receivers, members, lit);
        for (std::size_t i = 0; i < members.size(); ++i) {
          where[members[i]] = {thread, static_cast<std::uint32_t>(lit[i].size()), found[thread].lit.size()};
          found[thread].lit.insert(found[thread].lit.end(), lit[i].begin(), lit[i].end());
        }
      }
      afterTurn();
    }
  };
  {
    std::vector<std::jthread> others;
    for (unsigned t = 1; t < threads; ++t) others.emplace_back([&work, t] { work(t, [] {}); });
    work(0, [&] {
      if (!reportProgress(progress, double(std::min(next.load(), turns)) / double(std::max<std::size_t>(turns, 1)),
                          "sun hours"))
        stop = true;
    });
  }
  if (stop) return fail(ErrorCode::cancelled, "cancelled");
  return inOrder(where, found);
}

}  // namespace umbrage::study
