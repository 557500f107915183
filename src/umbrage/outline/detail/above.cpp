#include "umbrage/outline/detail/above.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace umbrage::outline::detail {
namespace {

class Cutter {
 public:
  explicit Cutter(CasterPart& part) : part_(part) {}

  // The polygon of the triangle above 0 as a fan.
  void add(const mesh::Triangle& t) {
    std::uint32_t corners[4];
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double za = part_.points[a].z, zb = part_.points[b].z;
      if (za >= 0.0) corners[count++] = a;
      if ((za > 0.0 && zb < 0.0) || (za < 0.0 && zb > 0.0)) corners[count++] = cut(a, b);
    }
    for (int k = 2; k < count; ++k) part_.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  }

 private:
  std::uint32_t cut(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [at, isNew] = cuts_.try_emplace({a, b}, static_cast<std::uint32_t>(part_.points.size()));
    if (isNew) {
      const Vec3 p = part_.points[a], q = part_.points[b];
      const Vec3 on = p + (p.z / (p.z - q.z)) * (q - p);
      part_.points.emplace_back(on.x, on.y, 0.0);
    }
    return at->second;
  }

  CasterPart& part_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> cuts_;
};

}  // namespace

CasterPart above(const CasterPart& part, double height) {
  CasterPart raised{part.name, part.points, {}, {}};
  for (Vec3& p : raised.points) p.z -= height;
  Cutter cutter(raised);
  for (const mesh::Triangle& t : part.triangles) {
    const double low = std::min({raised.points[t[0]].z, raised.points[t[1]].z, raised.points[t[2]].z});
    const double high = std::max({raised.points[t[0]].z, raised.points[t[1]].z, raised.points[t[2]].z});
    if (high <= 0.0) continue;
    if (low >= 0.0)
      raised.triangles.push_back(t);
    else
      cutter.add(t);
  }
  for (const mesh::Triangle& t : raised.triangles)
    for (const std::uint32_t corner : t) raised.bounds.add(raised.points[corner]);
  return raised;
}

}  // namespace umbrage::outline::detail
