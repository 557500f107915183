// Long searches for faults of exact sun hours (scripts/sweep hours).
//   dense [N]       N receivers in each of six scenes, every day of a different sort, against a ray every second
//   brute [N]       N receivers in a city of 120,000 triangles and N / 10 about a smooth solid of 60,000, against every triangle that may hide the sun, in double precision
#include <fmt/format.h>

#include <atomic>
#include <cstdlib>
#include <thread>

#include "hours/scenes.hpp"
#include "umbrage/math/predicates.hpp"

namespace umbrage::hours_tests {
namespace {

using std::chrono::hours;
using study::SunCourse;
using study::TimeSpan;

SunCourse dayAt(const sun::Place& place, std::chrono::year_month_day date) {
  const auto east = std::chrono::milliseconds(std::llround(place.longitude.degrees() * 240e3));
  const sun::Instant midnight =
      std::chrono::sys_days(date) - std::chrono::duration_cast<std::chrono::milliseconds>(east);
  return SunCourse::make(place, {midnight, midnight + hours(24)});
}

template <class Fn>
void inThreads(std::size_t count, Fn&& fn) {
  std::atomic<std::size_t> next{0};
  std::vector<std::jthread> threads;
  for (unsigned t = 0; t < std::max(1u, std::thread::hardware_concurrency()); ++t)
    threads.emplace_back([&] {
      for (std::size_t i; (i = next++) < count;) fn(i);
    });
}

std::vector<study::Receiver> receiversOf(const std::vector<Placed>& all) {
  std::vector<study::Receiver> out;
  for (const Placed& p : all) out.push_back(p.receiver);
  return out;
}

int dense(int count) {
  using namespace std::chrono;
  const struct {
    double latitude, longitude;
    year_month_day date;
  } kDays[] = {{48.2, 16.37, 2026y / March / 20},   {48.2, 16.37, 2026y / June / 21},
               {-33.9, 151.2, 2026y / October / 3}, {1.3, 103.8, 2026y / September / 23},
               {69.6, 18.9, 2026y / June / 1},      {48.2, 16.37, 2026y / September / 18}};
  int failed = 0, passed = 0, sceneNumber = 0;
  for (const NamedScene& named : sceneKinds(30)) {
    const auto& day = kDays[sceneNumber];
    const sun::Place place{Angle::degrees(day.latitude), Angle::degrees(day.longitude)};
    const Rays rays(named.scene);
    Random random(static_cast<unsigned>(100 + sceneNumber++));
    const std::vector<Placed> all = placed(rays, count, random);
    const auto exact = study::ExactHours::build(named.scene, place);
    const SunCourse course = dayAt(place, day.date);
    const auto found = exact->at(receiversOf(all), course);
    std::atomic<int> wrong{0}, bad{0};
    inThreads(all.size(), [&](std::size_t i) {
      const int n = disagreements(rays, all[i], found->lit(i), course);
      wrong += n;
      if (n == 0) return;
      ++bad;
      const Vec3 p = all[i].receiver.position;
      fmt::print("  {} receiver {} at {} {} {} (on {}): {} s\n", named.name, i, p.x, p.y, p.z,
                 static_cast<int>(all[i].on), n);
    });
    fmt::print("{:<8} {:>7} triangles, {} receivers, every second: {} receivers with {} seconds of disagreement\n",
               named.name, rays.surfaces().triangles.size(), count, bad.load(), wrong.load());
    failed += bad, passed += count - bad;
  }
  fmt::print("{} passed, {} failed\n", passed, failed);
  return failed == 0 ? 0 : 1;
}

// ---- against all triangles

// The sun every few minutes.
struct Steps {
  static constexpr double kSeconds = 240.0;
  const SunCourse& course;
  TimeSpan up;
  std::vector<Vec3> suns;
  explicit Steps(const SunCourse& c) : course(c), up(c.up().front()) {
    for (double t = 0.0;; t += kSeconds) {
      suns.push_back(at(std::min(t, length())));
      if (t >= length()) break;
    }
  }
  [[nodiscard]] double length() const { return double(up.length().count()) / 1000.0; }
  [[nodiscard]] double time(std::size_t i) const { return std::min(double(i) * kSeconds, length()); }
  // Twentieths of a second are below a millisecond's rounding of instants, so these are interpolated.
  [[nodiscard]] Vec3 at(double seconds) const {
    const double whole = std::floor(seconds);
    const auto exact = [&](double s) {
      return course.towards(up.from + std::chrono::milliseconds(std::llround(s * 1000.0)));
    };
    if (seconds == whole) return exact(seconds);
    return exact(whole) + (exact(whole + 1.0) - exact(whole)) * (seconds - whole);
  }
};

using Stretch = std::pair<double, double>;

// The times within [a, b] at which the sun stands before the inner sides of all planes, by halving.
void hidden(const Steps& steps, const Vec3 (&planes)[3], double a, double b, const Vec3& sunA, const Vec3& sunB,
            std::vector<Stretch>& out) {
  const double turn = 7.3e-5 * (b - a), bend = turn * turn / 8.0 + 1e-15;
  bool all = true;
  for (const Vec3& plane : planes) {
    const double fa = glm::dot(plane, sunA), fb = glm::dot(plane, sunB);
    if (std::max(fa, fb) < -bend) return;
    if (std::min(fa, fb) < bend) all = false;
  }
  if (all || b - a < 0.02) {
    out.push_back({a, b});
    return;
  }
  const double middle = 0.5 * (a + b);
  const Vec3 sun = steps.at(middle);
  hidden(steps, planes, a, middle, sunA, sun, out);
  hidden(steps, planes, middle, b, sun, sunB, out);
}

struct House {
  std::vector<std::uint32_t> triangles;
  Vec3 centre;
  double radius;
};

std::vector<Stretch> bruteLit(const scene::Surfaces& s, const std::vector<House>& houses, const Steps& steps,
                              const study::Receiver& r) {
  std::vector<Stretch> dark;
  const Vec3 n = glm::length(r.normal) > 0 ? glm::normalize(r.normal) : r.normal;
  if (n != Vec3(0.0)) {
    const Vec3 behind[3] = {-n, -n, -n};
    for (std::size_t i = 0; i + 1 < steps.suns.size(); ++i)
      hidden(steps, behind, steps.time(i), steps.time(i + 1), steps.suns[i], steps.suns[i + 1], dark);
  }
  const Vec3 p = r.position - s.origin;
  for (const House& house : houses) {
    const Vec3 to = house.centre - p;
    const double distance = glm::length(to);
    if (to.z + house.radius < 0.0) continue;
    const double angle = distance > house.radius ? std::asin(house.radius / distance) : 4.0;
    const double least = std::cos(std::min(angle + 0.02, 3.14159)) * distance;
    for (std::size_t i = 0; i + 1 < steps.suns.size(); ++i) {
      if (angle < 3.0 && glm::dot(steps.suns[i], to) < least) continue;
      for (const std::uint32_t t : house.triangles) {
        const Vec3 a = s.corner(t, 0) - p, b = s.corner(t, 1) - p, c = s.corner(t, 2) - p;
        const double side = glm::dot(glm::cross(a, b), c) < 0.0 ? -1.0 : 1.0;
        const Vec3 planes[3] = {glm::normalize(glm::cross(a, b)) * side, glm::normalize(glm::cross(b, c)) * side,
                                glm::normalize(glm::cross(c, a)) * side};
        hidden(steps, planes, steps.time(i), steps.time(i + 1), steps.suns[i], steps.suns[i + 1], dark);
      }
    }
  }
  std::sort(dark.begin(), dark.end());
  std::vector<Stretch> lit;
  double from = 0.0;
  for (const Stretch& d : dark) {
    if (d.first > from + 0.03) lit.push_back({from, d.first});
    from = std::max(from, d.second);
  }
  if (steps.length() > from + 0.03) lit.push_back({from, steps.length()});
  return lit;
}

// The longest time that is lit by one and dark by the other.
double worstStretch(std::span<const TimeSpan> exact, const std::vector<Stretch>& brute, const Steps& steps) {
  std::vector<std::pair<double, int>> events;
  for (const TimeSpan& t : exact) {
    events.push_back({double((t.from - steps.up.from).count()) / 1000.0, 0});
    events.push_back({double((t.to - steps.up.from).count()) / 1000.0, 0});
  }
  for (const Stretch& t : brute) events.push_back({t.first, 1}), events.push_back({t.second, 1});
  std::sort(events.begin(), events.end());
  bool in[2] = {false, false};
  double last = 0.0, worst = 0.0;
  for (const auto& [time, which] : events) {
    if (in[0] != in[1]) worst = std::max(worst, time - last);
    in[which] = !in[which], last = time;
  }
  return worst;
}

// Triangles that stand together in the mesh, a dozen each: a box of the city.
std::vector<House> housesOf(const scene::Surfaces& s) {
  std::vector<House> houses;
  for (std::uint32_t t = 0; t < s.triangles.size(); t += 12) {
    House h;
    Box3 box;
    for (std::uint32_t k = t; k < std::min<std::size_t>(t + 12, s.triangles.size()); ++k) {
      h.triangles.push_back(k);
      for (int c = 0; c < 3; ++c) box.add(s.corner(k, c));
    }
    h.centre = box.centre(), h.radius = box.radius();
    houses.push_back(std::move(h));
  }
  return houses;
}

// On the ground, and a centimetre before the boxes' faces.
std::vector<study::Receiver> inCity(const Rays& rays, const std::vector<House>& houses, std::size_t count,
                                    Random& random) {
  const scene::Surfaces& s = rays.surfaces();
  std::vector<study::Receiver> receivers;
  while (receivers.size() < count) {
    if (receivers.size() % 2 == 0) {
      const study::Receiver r{{uniform(random, -1000, 1000), uniform(random, -1000, 1000), 0.01}, {0, 0, 1}};
      if (!rays.meets(r.position, {0, 0, 1}, 0xffffffffu))
        receivers.push_back(r);
      else
        continue;
    }
    const auto t = static_cast<std::uint32_t>(random() % s.triangles.size());
    double u = uniform(random, 0, 1), v = uniform(random, 0, 1);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vec3 a = s.corner(t, 0), centre = houses[t / 12].centre;
    Vec3 n = glm::normalize(s.normal(t));
    const Vec3 p = a + u * (s.corner(t, 1) - a) + v * (s.corner(t, 2) - a);
    if (glm::dot(p - centre, n) < 0) n = -n;
    if (p.z > 0.0) receivers.push_back({p + 0.01 * n, n});
  }
  return receivers;
}

// Whether a point is so near to a surface that its normal may say on which side it lies.
bool mayTouch(const scene::Surfaces& s, const std::vector<House>& houses, const Vec3& p) {
  constexpr double kNear = 1e-3;
  return std::any_of(houses.begin(), houses.end(), [&](const House& h) {
    return glm::distance(h.centre, p) < h.radius + kNear &&
           std::any_of(h.triangles.begin(), h.triangles.end(), [&](std::uint32_t t) {
             return distanceToTriangle(p, s.corner(t, 0), s.corner(t, 1), s.corner(t, 2)) < kNear;
           });
  });
}

// Anywhere in the scene's lower part, facing up or all ways; some of them inside.
std::vector<study::Receiver> about(const Rays& rays, const std::vector<House>& houses, std::size_t count,
                                   Random& random) {
  std::vector<study::Receiver> receivers;
  while (receivers.size() < std::max<std::size_t>(count, 1)) {
    const Vec3 p = placed(rays, 1, random)[0].receiver.position;
    if (!mayTouch(rays.surfaces(), houses, p - rays.surfaces().origin))
      receivers.push_back({p, {0, 0, receivers.size() % 2 == 0 ? 1.0 : 0.0}});
  }
  return receivers;
}

struct Tally {
  int passed = 0, failed = 0;
};

void bruteDay(const std::string& name, const study::ExactHours& exact, const Rays& rays,
              const std::vector<House>& houses, const std::vector<study::Receiver>& receivers, const SunCourse& course,
              Tally& tally) {
  const scene::Surfaces& s = rays.surfaces();
  const Steps steps(course);
  const auto found = exact.at(receivers, course);
  std::atomic<int> beyond{0};
  std::vector<double> worst(receivers.size());
  inThreads(receivers.size(), [&](std::size_t i) {
    worst[i] = worstStretch(found->lit(i), bruteLit(s, houses, steps, receivers[i]), steps);
    if (worst[i] <= 1.0) return;
    ++beyond;
    const Vec3 p = receivers[i].position, n = receivers[i].normal;
    fmt::print("  receiver {} at {} {} {} facing {} {} {}: {:.2f} s\n", i, p.x, p.y, p.z, n.x, n.y, n.z, worst[i]);
  });
  const auto tenths = std::count_if(worst.begin(), worst.end(), [](double w) { return w > 0.1; });
  const auto day = std::chrono::floor<std::chrono::days>(course.span().from + hours(12));
  const std::chrono::year_month_day date{day};
  fmt::print("{} {}-{:02}-{:02}: {} receivers, {} triangles: {} beyond 1 s, {} beyond 0.1 s, worst {:.3f} s\n", name,
             int(date.year()), unsigned(date.month()), unsigned(date.day()), receivers.size(), s.triangles.size(),
             beyond.load(), tenths, *std::max_element(worst.begin(), worst.end()));
  std::fflush(stdout);
  tally.failed += beyond, tally.passed += static_cast<int>(receivers.size()) - beyond;
}

int brute(std::size_t count) {
  using namespace std::chrono;
  const sun::Place place{Angle::degrees(48.2), Angle::degrees(16.37)};
  Tally tally;
  {
    const scene::Scene s = sceneOf(ring(20, 6, 25, 300, 100));
    const Rays rays(s);
    const std::vector<House> houses = housesOf(rays.surfaces());
    Random random(4);
    const auto exact = study::ExactHours::build(s, place);
    for (const auto date : {2026y / July / 22, 2026y / March / 20})
      bruteDay("smooth", *exact, rays, houses, about(rays, houses, count / 20, random), dayAt(place, date), tally);
  }
  {
    Random random(3);
    const scene::Scene s = sceneOf(boxes(100, 20, random));
    const Rays rays(s);
    const std::vector<House> houses = housesOf(rays.surfaces());
    const auto exact = study::ExactHours::build(s, place);
    for (const auto date : {2026y / July / 22, 2026y / March / 20})
      bruteDay("city", *exact, rays, houses, inCity(rays, houses, count / 2, random), dayAt(place, date), tally);
  }
  fmt::print("{} passed, {} failed\n", tally.passed, tally.failed);
  return tally.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace umbrage::hours_tests

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const int count = argc > 2 ? std::atoi(argv[2]) : 0;
  if (what == "dense") return umbrage::hours_tests::dense(count > 0 ? count : 1000);
  if (what == "brute") return umbrage::hours_tests::brute(static_cast<std::size_t>(count > 0 ? count : 250000));
  return 2;
}
