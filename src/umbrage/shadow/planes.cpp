#include "umbrage/shadow/planes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

#include "umbrage/base/check.hpp"

namespace umbrage::shadow {
namespace {

// Corners are rounded to 2^-24 of their coordinates; the plane through three such corners errs by a few times as much beside them.
constexpr double kRounding = 0x1p-21;
// Normals of one plane differ by less, unless its triangles are slivers.
constexpr double kNormalCells = 64.0;

double largest(const Vec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

// A large component. The weights move ties, where rounding decides, away from the angles that people build at.
int mainAxis(const Vec3& n) {
  const Vec3 size = glm::abs(n) * Vec3(1.0213, 1.0091, 1.0);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

// One of the two normals of a plane, the same for both of their senses.
Vec3 oneSense(const Vec3& n) { return n[mainAxis(n)] < 0.0 ? -n : n; }

bool lies(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec4& equation, double reach) {
  for (int k = 0; k < 3; ++k)
    if (!(std::abs(glm::dot(Vec3(equation), surfaces.corner(triangle, k)) + equation.w) <= kRounding * reach))
      return false;
  return true;
}

struct Candidate {
  Vec4 equation;
  double reach;  // largest coordinate of what made it
  double area = 0.0;
};

// Candidates by the cell of their normal, and there by distance.
class Candidates {
 public:
  // The plane that a triangle lies in; made if there is none.
  std::uint32_t planeOf(const scene::Surfaces& surfaces, std::uint32_t triangle) {
    const Vec3 crossed = surfaces.normal(triangle);
    const double twice = glm::length(crossed);
    const Vec3 normal = oneSense(crossed / twice), a = surfaces.corner(triangle, 0);
    double reach = 0.0;
    for (int k = 0; k < 3; ++k) reach = std::max(reach, largest(surfaces.corner(triangle, k)));
    std::uint32_t found = find(surfaces, triangle, normal, a, reach);
    if (found == kNone) {
      found = static_cast<std::uint32_t>(all_.size());
      all_.push_back({Vec4(normal, -glm::dot(normal, a)), reach});
      cells_[cellOf(normal, 0, 0)].emplace(all_.back().equation.w, found);
    }
    all_[found].area += 0.5 * twice;
    return found;
  }
  [[nodiscard]] const std::vector<Candidate>& all() const { return all_; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // The normal's main component is 1 after division, so that two numbers say where it points.
  static std::uint64_t cellOf(const Vec3& n, int du, int dv) {
    const int axis = mainAxis(n);
    const auto cell = [&](int which, int d) {
      return static_cast<std::uint64_t>(std::llround(n[(axis + which) % 3] / n[axis] * kNormalCells) + d + 4096);
    };
    return static_cast<std::uint64_t>(axis) << 32 | cell(1, du) << 16 | cell(2, dv);
  }

  [[nodiscard]] std::uint32_t find(const scene::Surfaces& surfaces, std::uint32_t triangle, const Vec3& normal,
                                   const Vec3& a, double reach) const {
    const double w = -glm::dot(normal, a), around = reach / kNormalCells + kRounding * reach;
    for (int du = -1; du <= 1; ++du)
      for (int dv = -1; dv <= 1; ++dv) {
        const auto cell = cells_.find(cellOf(normal, du, dv));
        if (cell == cells_.end()) continue;
        const auto end = cell->second.upper_bound(w + around);
        for (auto at = cell->second.lower_bound(w - around); at != end; ++at)
          if (lies(surfaces, triangle, all_[at->second].equation, std::max(reach, all_[at->second].reach)))
            return at->second;
      }
    return kNone;
  }

  std::vector<Candidate> all_;
  std::unordered_map<std::uint64_t, std::multimap<double, std::uint32_t>> cells_;
};

ScenePlanes collect(const scene::Surfaces& surfaces, const std::vector<std::uint32_t>& planeOf,
                    const std::vector<Vec4>& equations) {
  ScenePlanes out;
  for (const Vec4& e : equations) out.planes.push_back({e});
  out.planeOf.assign(surfaces.triangles.size(), 0);
  for (std::uint32_t t = 0; t < planeOf.size(); ++t) {
    if (planeOf[t] >= equations.size()) continue;
    out.planeOf[t] = static_cast<std::uint8_t>(planeOf[t] + 1);
    ScenePlane& plane = out.planes[planeOf[t]];
    plane.area += 0.5 * glm::length(surfaces.normal(t));
    for (int k = 0; k < 3; ++k) plane.bounds.add(surfaces.corner(t, k));
  }
  return out;
}

constexpr std::uint32_t kNoPlane = ~std::uint32_t{0};

ScenePlanes theGiven(const scene::Surfaces& surfaces, const std::vector<Plane>& given) {
  std::vector<Vec4> equations;
  for (const Plane& plane : given) {
    const Vec3 normal = glm::normalize(plane.normal);
    equations.emplace_back(normal, -glm::dot(normal, plane.point - surfaces.origin));
  }
  std::vector<std::uint32_t> planeOf(surfaces.triangles.size(), kNoPlane);
  for (std::uint32_t t = 0; t < planeOf.size(); ++t) {
    if (!(glm::length(surfaces.normal(t)) > 0.0)) continue;
    double reach = 0.0;
    for (int k = 0; k < 3; ++k) reach = std::max(reach, largest(surfaces.corner(t, k)));
    for (std::uint32_t p = 0; p < equations.size() && planeOf[t] == kNoPlane; ++p)
      if (lies(surfaces, t, equations[p], std::max(reach, std::abs(equations[p].w)))) planeOf[t] = p;
  }
  return collect(surfaces, planeOf, equations);
}

}  // namespace

ScenePlanes findPlanes(const scene::Surfaces& surfaces, const PlaneSearch& search) {
  UMBRAGE_CHECK(search.most <= kMostPlanes && search.given.size() <= kMostPlanes, "so many planes");
  if (!search.given.empty()) return theGiven(surfaces, search.given);
  // The largest triangle of a plane tells best where it is.
  const auto count = static_cast<std::uint32_t>(surfaces.triangles.size());
  std::vector<double> area(count);
  for (std::uint32_t t = 0; t < count; ++t) area[t] = glm::length(surfaces.normal(t));
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return area[a] > area[b]; });
  Candidates candidates;
  std::vector<std::uint32_t> planeOf(count, kNoPlane);
  for (const std::uint32_t t : order)
    if (area[t] > 0.0) planeOf[t] = candidates.planeOf(surfaces, t);

  const Box3& box = surfaces.casterBounds.empty() ? surfaces.bounds : surfaces.casterBounds;
  const double least = search.leastShare * 4.0 * box.radius() * box.radius();
  std::vector<std::uint32_t> chosen(candidates.all().size());
  std::iota(chosen.begin(), chosen.end(), 0u);
  std::erase_if(chosen, [&](std::uint32_t c) { return !(candidates.all()[c].area >= least); });
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](auto a, auto b) { return candidates.all()[a].area > candidates.all()[b].area; });
  if (chosen.size() > search.most) chosen.resize(search.most);
  std::vector<std::uint32_t> rank(candidates.all().size(), kNoPlane);
  std::vector<Vec4> equations;
  for (const std::uint32_t c : chosen) {
    rank[c] = static_cast<std::uint32_t>(equations.size());
    equations.push_back(candidates.all()[c].equation);
  }
  for (std::uint32_t& p : planeOf)
    if (p != kNoPlane) p = rank[p];
  return collect(surfaces, planeOf, equations);
}

}  // namespace umbrage::shadow
