// How the weights of the literature relate to multiplicities.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/shapes.hpp"
#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

struct Face {
  std::array<std::uint32_t, 3> corner;  // counter-clockwise, as the file has it
  bool lit = false;
};

// Bergeron's rule, from the windings of the file alone: a contour edge between a lit and an averted face counts 2, an edge of one face only
// counts 1, and an edge between two faces that are both lit or both averted counts nothing.
std::map<Ends, int> bergeron(const std::vector<Face>& faces) {
  std::map<Ends, std::vector<bool>> lit;
  for (const Face& f : faces)
    for (std::size_t k = 0; k < 3; ++k) lit[std::minmax(f.corner[k], f.corner[(k + 1) % 3])].push_back(f.lit);
  std::map<Ends, int> weight;
  for (const auto& [edge, sides] : lit) {
    EXPECT_LE(sides.size(), 2u) << "the rule is for manifolds";
    if (sides.size() == 1) weight[edge] = 1;
    if (sides.size() == 2 && sides[0] != sides[1]) weight[edge] = 2;
  }
  return weight;
}

struct Model {
  CasterSet casters;
  std::vector<mesh::Triangle> wound;  // as they were given

  explicit Model(const shapes::Mesh& m) {
    std::vector<Vec3f> positions(m.positions.begin(), m.positions.end());
    std::vector<mesh::Triangle> triangles(m.triangles.begin(), m.triangles.end());
    casters = buildCasters(positions, triangles);
    const auto welded = [&](std::uint32_t i) {
      const auto found = std::find(casters.positions.begin(), casters.positions.end(), positions[i]);
      return static_cast<std::uint32_t>(found - casters.positions.begin());
    };
    for (const mesh::Triangle& t : triangles) {
      const mesh::Triangle w{welded(t[0]), welded(t[1]), welded(t[2])};
      if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) wound.push_back(w);
    }
  }

  [[nodiscard]] std::vector<Face> seenBy(const Vec4& light) const {
    std::vector<Face> faces;
    for (const mesh::Triangle& t : wound) {
      const Vec3 a = casters.position(t[0]), b = casters.position(t[1]), c = casters.position(t[2]);
      faces.push_back({{t[0], t[1], t[2]}, glm::dot(glm::cross(b - a, c - a), Vec3(light) - a * light.w) > 0.0});
    }
    return faces;
  }
};

shapes::Mesh bowl() {
  shapes::Mesh m = shapes::sphere({0, 0, 0}, 1, 14, 9);
  std::erase_if(m.triangles, [&](const auto& t) { return m.positions[t[0]].z > 0.35; });
  return m;
}
shapes::Mesh wavySheet() {
  return shapes::grid(9, 7, false, false,
                      [](double u, double v) { return Vec3(4 * u - 2, 3 * v - 1, std::sin(7 * u + 3 * v)); });
}

std::map<Ends, int> sizes(const Silhouette& silhouette) {
  std::map<Ends, int> out;
  for (const SilhouetteEdge& e : silhouette.edges) out[std::minmax(e.a, e.b)] = std::abs(e.multiplicity);
  return out;
}

TEST(BergeronsWeights, AreTheSizesOfMultiplicities) {
  shapes::Random random(12);
  int ones = 0, twos = 0;
  for (const shapes::Mesh& mesh :
       {bowl(), wavySheet(), shapes::box({0, 0, 0}, {1, 2, 3}), shapes::knot({0, 0, 0}, 1, 0.3, 40, 8)}) {
    const Model model(mesh);
    for (int i = 0; i < 40; ++i) {
      const Vec4 light(random.in(-5, 5), random.in(-5, 5), random.in(-5, 5), i % 2);
      const auto found = sizes(findSilhouette(model.casters, light, {.countEverySurface = true}));
      const auto weights = bergeron(model.seenBy(light));
      EXPECT_EQ(found, weights);
      for (const auto& [edge, weight] : weights) (weight == 1 ? ones : twos) += 1;
    }
  }
  EXPECT_GT(ones, 1000);
  EXPECT_GT(twos, 1000);
}

// What hides a point is counted once by lit faces alone and twice with the averted ones: Crow's weight 1 for closed models is half of Bergeron's.
TEST(BergeronsWeights, AreTwiceThoseOfCrowForConvexSolids) {
  const Model model(shapes::sphere({0, 0, 0}, 1, 12, 8));
  const Vec4 light(3, -2, 5, 1);
  const Silhouette lit = findSilhouette(model.casters, light),
                   all = findSilhouette(model.casters, light, {.countEverySurface = true});
  auto crow = sizes(lit);
  for (auto& [edge, weight] : crow) weight *= 2;
  EXPECT_EQ(crow, sizes(all));
  const Vec3 behind(-1.5, 1.0, -2.5);
  EXPECT_EQ(countSurfaces(model.casters, lit, behind).count, 1);
  EXPECT_EQ(countSurfaces(model.casters, all, behind).count, 2);
}

}  // namespace
}  // namespace umbrage::shadow
