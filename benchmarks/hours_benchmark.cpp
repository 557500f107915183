// Exact sun hours against sampling with Embree in its fastest form, one point with eight consecutive suns a packet: paired rounds in one
// run on one thread. umbrage_hours_benchmark [ROUNDS [POINTS [city|knot]]]
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <immintrin.h>
#include <ctime>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "embree_casters.hpp"
#include "median.hpp"
#include "scenes/staged_scene.hpp"
#include "umbrage/scene/surfaces.hpp"
#include "umbrage/study/exact_hours.hpp"

namespace umbrage::benchmarks {
namespace {

// Time of this thread alone: what else the machine does is not counted.
struct Clock {
  using time_point = double;
  static double now() {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e3 + double(t.tv_nsec) * 1e-6;
  }
};
using study::Receiver;

double millisecondsSince(Clock::time_point start) { return Clock::now() - start; }

const sun::Place kPlace{Angle::degrees(48), Angle::degrees(16)};

// ---- the rival

class Rays {
 public:
  explicit Rays(const scene::Surfaces& s) {
    addCasters(device_, tree_, s);
    const auto start = Clock::now();
    rtcCommitScene(tree_);
    buildTime = millisecondsSince(start);
  }
  ~Rays() { rtcReleaseScene(tree_), rtcReleaseDevice(device_); }
  Rays(const Rays&) = delete;
  Rays& operator=(const Rays&) = delete;

  [[nodiscard]] bool occluded(const Vec3& from, const Vec3& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{float(from.x), float(from.y), float(from.z), 0.0f, float(to.x), float(to.y),
               float(to.z),   0.0f,          1e30f,         ~0u,  0,           0};
    rtcOccluded1(tree_, &context, &ray);
    return ray.tfar < 0.0f;
  }

  // Hours of sun by samples in the middles of steps.
  void sample(const std::vector<Receiver>& receivers, const std::vector<Vec3f>& suns, double hoursEach,
              std::vector<float>& out) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
      const Vec3f p(receivers[i].position), n(receivers[i].normal);
      int lit = 0;
      for (std::size_t first = 0; first < suns.size(); first += 8) {
        alignas(32) int valid[8];
        alignas(32) RTCRay8 rays;
        int any = 0;
        for (std::size_t k = 0; k < 8; ++k) {
          const Vec3f& d = suns[std::min(first + k, suns.size() - 1)];
          valid[k] = first + k < suns.size() && glm::dot(n, d) > 0.0f ? -1 : 0;
          any |= valid[k];
          rays.org_x[k] = p.x, rays.org_y[k] = p.y, rays.org_z[k] = p.z;
          rays.dir_x[k] = d.x, rays.dir_y[k] = d.y, rays.dir_z[k] = d.z;
          rays.tnear[k] = 0.0f, rays.tfar[k] = 1e30f, rays.mask[k] = ~0u, rays.time[k] = 0.0f, rays.flags[k] = 0;
        }
        if (any == 0) continue;
        rtcOccluded8(valid, tree_, &context, &rays);
        for (std::size_t k = 0; k < 8; ++k) lit += valid[k] != 0 && rays.tfar[k] > 0.0f ? 1 : 0;
      }
      out[i] = static_cast<float>(lit * hoursEach);
    }
  }

  double buildTime = 0.0;

 private:
  RTCDevice device_ = rtcNewDevice(nullptr);
  RTCScene tree_ = rtcNewScene(device_);
};

// ---- receivers

// Places on the ground beside the casters, in blocks, as a program that knows its trade hands them out.
std::vector<Receiver> onGround(const Rays& rays, std::size_t count, double half) {
  const auto across = static_cast<std::uint32_t>(std::sqrt(double(count)) * 1.45);
  std::vector<std::pair<std::uint64_t, Receiver>> found;
  for (std::uint32_t y = 0; y < across; ++y)
    for (std::uint32_t x = 0; x < across; ++x) {
      const Receiver r{{(x + 0.5) / across * 2 * half - half, (y + 0.5) / across * 2 * half - half, 0.01}, {0, 0, 1}};
      if (rays.occluded(r.position, r.normal)) continue;
      std::uint64_t order = 0;
      for (int k = 0; k < 16; ++k)
        order |= std::uint64_t{x >> k & 1u} << (2 * k) | std::uint64_t{y >> k & 1u} << (2 * k + 1);
      found.push_back({order, r});
    }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Receiver> out;
  const std::size_t take = std::min(count, found.size());
  for (std::size_t i = 0; i < take; ++i) out.push_back(found[i * found.size() / take].second);
  return out;
}

// Points spread over the upright faces of the boxes, or all faces of other meshes, a hundredth of a metre before them.
void addFaces(const scene::Scene& s, std::size_t count, std::vector<Receiver>& out) {
  std::size_t triangles = 0;
  for (const auto& instance : s.instances)
    if (instance.casts) triangles += s.meshes[instance.mesh]->triangles.size();
  const double each = double(count) / double(triangles);
  double due = 0.0;
  std::uint32_t random = 777;
  const auto next = [&] { return random = random * 1664525u + 1013904223u, double(random >> 8) / double(1u << 24); };
  for (const auto& instance : s.instances) {
    if (!instance.casts) continue;
    const mesh::Mesh& m = *s.meshes[instance.mesh];
    for (const mesh::Triangle& t : m.triangles) {
      const Vec3 a = m.positions[t[0]], b = m.positions[t[1]], c = m.positions[t[2]];
      const Vec3 n = glm::normalize(glm::cross(b - a, c - a));
      for (due += each * (m.triangles.size() == 12 ? 1.5 : 1.0); due >= 1.0; due -= 1.0) {
        if (m.triangles.size() == 12 && std::abs(n.z) > 0.5) continue;
        double u = next(), v = next();
        if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
        Receiver r{a + u * (b - a) + v * (c - a) + 0.01 * n, n};
        r.position.z = std::max(r.position.z, 0.1);
        out.push_back(r);
      }
    }
  }
}

// A smooth torus knot, 70,000 triangles.
scene::Scene smoothKnot() {
  constexpr std::uint32_t kColumns = 1000, kRows = 35;
  const auto centre = [](double a) {
    const double r = 10 * (std::cos(3 * a) + 2);
    return Vec3(r * std::cos(2 * a), -r * std::sin(2 * a), 18 - 10 * std::sin(3 * a));
  };
  mesh::Mesh m;
  for (std::uint32_t i = 0; i < kColumns; ++i) {
    const double a = 2 * std::numbers::pi * i / kColumns;
    const Vec3 along = glm::normalize(centre(a + 1e-2) - centre(a - 1e-2));
    const Vec3 x = glm::normalize(glm::cross(along, Vec3(0.31, -0.2, 0.9))), y = glm::cross(along, x);
    for (std::uint32_t j = 0; j < kRows; ++j) {
      const double b = 2 * std::numbers::pi * j / kRows;
      m.positions.push_back(centre(a) + 4 * std::cos(b) * x + 4 * std::sin(b) * y);
      const std::uint32_t here = i * kRows, beside = (i + 1) % kColumns * kRows, above = (j + 1) % kRows;
      m.triangles.push_back({here + j, beside + above, beside + j});
      m.triangles.push_back({here + j, here + above, beside + above});
    }
  }
  scene::Scene s;
  s.source = "smooth knot";
  s.materials.push_back({});
  s.meshes.push_back(std::make_shared<const mesh::Mesh>(std::move(m)));
  s.instances.push_back({"knot", 0});
  return s;
}

// ---- one comparison

struct Day {
  std::string name;
  std::chrono::year_month_day date;
};

void compare(const std::string& name, const study::ExactHours& exact, const Rays& rays,
             const std::vector<Receiver>& receivers, const Day& day, int rounds) {
  const sun::Instant midnight = std::chrono::sys_days(day.date) - std::chrono::hours(1);
  const auto course = study::SunCourse::make(kPlace, {midnight, midnight + std::chrono::hours(24)});
  const study::TimeSpan up = course.up().front();
  const auto samples = [&](double minutes) {
    const auto n = static_cast<int>(std::lround(double(up.length().count()) / 60e3 / minutes));
    std::vector<Vec3f> suns;
    for (int i = 0; i < n; ++i) {
      const Vec3 d = course.towards(
          up.from + std::chrono::milliseconds(static_cast<long long>((i + 0.5) / n * double(up.length().count()))));
      suns.emplace_back(d);  // east, north, up are the axes of these scenes
    }
    return suns;
  };
  const auto every15 = samples(15), every5 = samples(5);
  const double length = double(up.length().count()) / 3.6e6;
  std::vector<float> by15(receivers.size()), by5(receivers.size());
  std::vector<double> exactTimes, ratio15, ratio5, times15, times5;
  study::SunHours hours;
  for (int round = 0; round < rounds; ++round) {
    auto start = Clock::now();
    rays.sample(receivers, every15, length / double(every15.size()), by15);
    times15.push_back(millisecondsSince(start));
    start = Clock::now();
    rays.sample(receivers, every5, length / double(every5.size()), by5);
    times5.push_back(millisecondsSince(start));
    start = Clock::now();
    hours = std::move(*exact.at(receivers, course));
    exactTimes.push_back(millisecondsSince(start));
    ratio15.push_back(exactTimes.back() / times15.back());
    ratio5.push_back(exactTimes.back() / times5.back());
  }
  double mean5 = 0.0, worst5 = 0.0, lit = 0.0, pieces = 0.0;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const double h = double(hours.total(i).count()) / 3.6e6, off = std::abs(h - double(by5[i])) * 60.0;
    mean5 += off, worst5 = std::max(worst5, off), lit += h, pieces += double(hours.lit(i).size());
  }
  const auto n = double(receivers.size());
  fmt::print(
      "{:<22} {:<9} {:>7} points  exact {:6.2f} us/pt  15 min {:6.2f}  5 min {:6.2f}  exact/15 min {:.3f}  exact/5 min "
      "{:.3f}"
      "  (5 min errs {:.2f} min, at worst {:.1f}; mean {:.3f} h in {:.2f} pieces)\n",
      name, day.name, receivers.size(), median(exactTimes) * 1e3 / n, median(times15) * 1e3 / n,
      median(times5) * 1e3 / n, median(ratio15), median(ratio5), mean5 / n, worst5, lit / n, pieces / n);
  std::fflush(stdout);
}

int run(int rounds, std::size_t points, const std::string& only) {
  using namespace std::chrono;
  const Day summer{"22 July", 2026y / July / 22}, equinox{"20 March", 2026y / March / 20};
  study::ExactHoursOptions one;
  one.threads = 1;
  if (only != "knot") {
    const scene::Scene s = city().scene;
    const scene::Surfaces surfaces = scene::flatten(s);
    const Rays rays(surfaces);
    const auto start = Clock::now();
    const auto exact = study::ExactHours::build(s, kPlace, one);
    fmt::print("city: {} triangles, own tree {:.0f} ms, Embree's {:.0f} ms\n", scene::triangleCount(s),
               millisecondsSince(start), rays.buildTime);
    std::vector<Receiver> receivers = onGround(rays, points / 2, 1000);
    addFaces(s, points - receivers.size(), receivers);
    for (const Day& day : {summer, equinox}) compare("city, ground+facades", *exact, rays, receivers, day, rounds);
  }
  if (only != "city") {
    const scene::Scene s = smoothKnot();
    const scene::Surfaces surfaces = scene::flatten(s);
    const Rays rays(surfaces);
    const auto start = Clock::now();
    const auto exact = study::ExactHours::build(s, kPlace, one);
    fmt::print("smooth knot: {} triangles, own tree {:.0f} ms, Embree's {:.0f} ms\n", scene::triangleCount(s),
               millisecondsSince(start), rays.buildTime);
    const std::vector<Receiver> ground = onGround(rays, points / 4, 60);
    std::vector<Receiver> faces;
    addFaces(s, points / 4, faces);
    for (const Day& day : {summer, equinox}) {
      compare("smooth knot, ground", *exact, rays, ground, day, rounds);
      compare("smooth knot, itself", *exact, rays, faces, day, rounds);
    }
  }
  return 0;
}

}  // namespace
}  // namespace umbrage::benchmarks

int main(int argc, char** argv) {
  // As Embree asks of those who call it.
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _mm_setcsr(_mm_getcsr() | 0x40);
  return umbrage::benchmarks::run(argc > 1 ? std::atoi(argv[1]) : 5,
                                  argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 250000, argc > 3 ? argv[3] : "");
}
