#include "umbrage/shadow/hidden_casters.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "umbrage/shadow/volume.hpp"

namespace umbrage::shadow {
namespace {

const std::vector<mesh::Triangle> kFaces{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

struct Model {
  std::vector<Vec3f> positions;
  std::vector<mesh::Triangle> triangles;

  void addBox(const Vec3f& low, const Vec3f& size, bool open = false) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    for (int i = 0; i < 8; ++i)
      positions.push_back(low + size * Vec3f(float(i & 1), float((i >> 1) & 1), float((i >> 2) & 1)));
    for (const mesh::Triangle& t : kFaces) triangles.push_back({base + t[0], base + t[1], base + t[2]});
    if (open) triangles.pop_back();
  }
  [[nodiscard]] CasterSet casters() const { return buildCasters(positions, triangles); }
};

constexpr Vec4 kOverhead(0.02, 0.01, 1.0, 0.0);

TEST(HiddenCasters, ABoxUnderALargerOne) {
  Model m;
  m.addBox({0, 0, 5}, {4, 4, 1});
  m.addBox({1, 1, 0}, {1, 1, 1});
  m.addBox({9, 9, 0}, {1, 1, 1});
  const HiddenCasters hidden = findHiddenCasters(m.casters(), kOverhead);
  EXPECT_EQ(hidden.component, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(hidden.count, 1u);
  EXPECT_EQ(findHiddenCasters(m.casters(), {1.5, 1.5, 3, 1}).count, 0u);  // a lamp between them
  EXPECT_EQ(findHiddenCasters(m.casters(), {2, 2, 60, 1}).count, 1u);
  EXPECT_EQ(findHiddenCasters(m.casters(), {2, 2, 5.5, 1}).count, 0u);  // a lamp inside the upper one
}

TEST(HiddenCasters, NoneBehindWhatIsOpenNorBehindTwoTogether) {
  Model open;
  open.addBox({0, 0, 5}, {4, 4, 1}, true);
  open.addBox({1, 1, 0}, {1, 1, 1});
  EXPECT_EQ(findHiddenCasters(open.casters(), kOverhead).count, 0u);
  Model two;
  two.addBox({0, 0, 5}, {1.5f, 4, 1});
  two.addBox({1.6f, 0, 5}, {1.5f, 4, 1});
  two.addBox({1, 1, 0}, {1, 1, 1});  // half under one, half under the other, a ray of light between
  EXPECT_EQ(findHiddenCasters(two.casters(), kOverhead).count, 0u);
}

TEST(HiddenCasters, OneOfSeveralBoxesInOnePlaceStays) {
  Model m;
  m.addBox({0, 0, 0}, {2, 2, 2});
  m.addBox({0, 0, 0.001f}, {2, 2, 1.998f});
  m.addBox({0.5f, 0.5f, 0.5f}, {1, 1, 1});
  const HiddenCasters hidden = findHiddenCasters(m.casters(), kOverhead);
  EXPECT_EQ(hidden.component[0], 0);
  EXPECT_EQ(hidden.component[2], 1);
}

TEST(HiddenCasters, AnOpenMeshMayBeHidden) {
  Model m;
  m.addBox({0, 0, 5}, {4, 4, 1});
  m.addBox({1, 1, 0}, {1, 1, 1}, true);
  EXPECT_EQ(findHiddenCasters(m.casters(), kOverhead).count, 1u);
}

// Whatever is left out, the same points are in shadow.
RC_GTEST_PROP(HiddenCasters, LeavingThemOutChangesNoShadow, ()) {
  const auto coordinate = rc::gen::inRange(-4, 5);
  const auto size = rc::gen::inRange(1, 4);
  Model m;
  m.addBox({-3, -3, 4}, {7, 7, 1});
  const int boxes = *rc::gen::inRange(1, 12);
  for (int i = 0; i < boxes; ++i)
    m.addBox({float(*coordinate), float(*coordinate), float(*coordinate)}, {float(*size), float(*size), float(*size)},
             *rc::gen::inRange(0, 4) == 0);
  const CasterSet casters = m.casters();
  const auto far = rc::gen::inRange(-12, 13);
  const Vec3 p(*far, *far, *far + 8);
  const Vec4 light(p, *rc::gen::inRange(0, 2) == 1 || p == Vec3(0.0) ? 1.0 : 0.0);
  const HiddenCasters hidden = findHiddenCasters(casters, light);
  RC_CLASSIFY(hidden.count > 0, "some are hidden");
  const Silhouette all = findSilhouette(casters, light);
  const Silhouette rest = without(casters, all, hidden.component);
  for (const Vec3& offset : {Vec3(0.3113, 0.2371, 0.1709), Vec3(0.7317, 0.8123, 0.3391), Vec3(0.1193, 0.6113, 0.9127)})
    for (int i = 0; i < 8; ++i) {
      const Vec3 point = Vec3(*far, *far, *far) + offset;
      const SurfaceCount before = countSurfaces(casters, all, point), after = countSurfaces(casters, rest, point);
      if (before.unclear + after.unclear > 0) continue;
      RC_ASSERT((before.count > 0) == (after.count > 0));
    }
}

}  // namespace
}  // namespace umbrage::shadow
