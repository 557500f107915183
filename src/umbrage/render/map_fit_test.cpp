// How lights look at a scene, without OpenGL: what maps must hold, whatever eye and light.
#include "umbrage/render/map_fit.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"
#include "support/village.hpp"

namespace umbrage::render {
namespace {

using support::Truth;

struct Looked {
  scene::Surfaces surfaces;
  scene::Camera camera;
  scene::Light light;
  View view;
  SeenReceivers receivers;
  std::vector<std::uint8_t> facing;

  Looked(const scene::Scene& s, const scene::Camera& c, const scene::Light& l)
      : surfaces(scene::flatten(s)),
        camera(c),
        light(l),
        view(viewOf(c, surfaces.bounds.radius())),
        receivers(seenReceivers(surfaces, view, c)),
        facing(shadow::visibleSideFacesLight(surfaces, Vec4(c.eye - surfaces.origin, 1.0),
                                             scene::homogeneous(l, surfaces.origin))) {}
  [[nodiscard]] MapRequest request() const { return {surfaces, view, camera, receivers, light, facing}; }
  [[nodiscard]] Vec3 at(const ViewSample& sample) const {
    const Vec3 n = surfaces.normal(sample.triangle),
               ray = scene::pixelRays(camera).through(sample.pixel.x, sample.pixel.y);
    return ray * (glm::dot(n, surfaces.corner(sample.triangle, 0) - (camera.eye - surfaces.origin)) / glm::dot(n, ray));
  }
};

Looked random(shapes::Random& r) {
  const scene::Scene s = scene::withGround(shapes::scene({shapes::soup(static_cast<std::uint64_t>(r.whole(1, 999)), 12,
                                                                       [](shapes::Random& x) {
                                                                         return x.point({{-2, -2, 0.2}, {2, 2, 3}});
                                                                       })}),
                                           0.0);
  const scene::Camera camera =
      support::cameraFrom(r.point({{-4, -4, 0.3}, {4, 4, 5}}), r.point({{-1, -1, 0}, {1, 1, 2}}));
  const Vec3 p = r.point({{-4, -4, 0.4}, {4, 4, 6}});
  const int kind = r.whole(0, 2);
  if (kind == 0) return {s, camera, {scene::DirectionalLight{-p}}};
  if (kind == 1) return {s, camera, {scene::PointLight{p}}};
  return {s, camera, {scene::SpotLight{p, r.point({{-1, -1, 0}, {1, 1, 1}}) - p, Angle::degrees(r.in(20, 80))}}};
}

TEST(SeenReceivers, SamplesShowTheNearestSurface) {
  shapes::Random r(3);
  std::size_t looked = 0;
  for (int i = 0; i < 30; ++i) {
    const Looked l = random(r);
    const Truth truth{l.surfaces};
    for (const ViewSample& sample : l.receivers.samples) {
      const Vec3 ray = scene::pixelRays(l.camera).through(sample.pixel.x, sample.pixel.y);
      EXPECT_EQ(truth.hit(l.camera.eye, ray, 0.0, std::numeric_limits<double>::infinity(), false), sample.triangle);
      ++looked;
    }
  }
  EXPECT_GT(looked, 10000u);
}

TEST(Clip, KeepsWhatIsInside) {
  std::vector<Vec3> out;
  const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  clip(square, {1, 0, 0, -1}, out);
  ASSERT_EQ(out.size(), 4u);
  for (const Vec3& p : out) EXPECT_GE(p.x, 1.0);
  clip(square, {1, 0, 0, -3}, out);
  EXPECT_TRUE(out.empty());
  clip(square, {1, 0, 0, 0}, out);
  EXPECT_EQ(out.size(), 4u);
}

// 1. What is seen, faces the light and has a caster before it lies in a map, at a depth within 0..1.
// 2. In every map, what lies on the way from a point to the light is seen at the same place, and nearer to the light.
TEST(MapFit, HoldsAllThatMayLieInShadowInTheLightsOrder) {
  shapes::Random r(7);
  std::size_t shadowed = 0, distorted = 0;
  for (int i = 0; i < 150; ++i) {
    const Looked l = random(r);
    const Truth truth{l.surfaces};
    const MapRequest request = l.request();
    const Vec4 light = scene::homogeneous(l.light, l.camera.eye);
    const MapFit fits[] = {uniformMaps(request), perspectiveMaps(request)};
    distorted += fits[1].movedBack.has_value();
    EXPECT_LE(fits[1].pixelsPerTexel, fits[0].pixelsPerTexel);
    for (const ViewSample& sample : l.receivers.samples) {
      const Vec3 p = l.at(sample);
      if (l.facing[sample.triangle] == 0 || !scene::insideCone(l.light, l.camera.eye + p)) continue;
      const Vec3 towards = scene::towardsLight(light, p);
      const double far = light.w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
      double where = 0.0;
      if (truth.hit(l.camera.eye + p, towards, 1e-6, far, true, &where) == shadow::kNoTriangle) continue;
      const Vec3 caster = p + where * towards;
      ++shadowed;
      for (const MapFit& fit : fits) {
        std::size_t maps = 0;
        for (const MapView& map : fit.maps) {
          const Vec4 c = map.toMap * Vec4(p, 1.0), q = map.toMap * Vec4(caster, 1.0);
          if (!(glm::dot(map.drawn, Vec4(p, 1.0)) > 0.0 && c.w > 0.0 && std::abs(c.x) <= c.w * (1 + 1e-9) &&
                std::abs(c.y) <= c.w * (1 + 1e-9)))
            continue;
          ++maps;
          EXPECT_GE(c.z / c.w, 0.0);
          EXPECT_LE(c.z / c.w, 1.0);
          ASSERT_GT(q.w, 0.0);
          EXPECT_GT(glm::dot(map.drawn, Vec4(caster, 1.0)), 0.0);
          EXPECT_NEAR(q.x / q.w, c.x / c.w, 1e-6);
          EXPECT_NEAR(q.y / q.w, c.y / c.w, 1e-6);
          EXPECT_GT(q.z / q.w, c.z / c.w);
        }
        EXPECT_GE(maps, 1u);
      }
      if (HasFailure()) return;
    }
  }
  std::printf("%zu shadowed samples, %zu of 150 maps in a perspective\n", shadowed, distorted);
  EXPECT_GT(shadowed, 2000u);
  EXPECT_GT(distorted, 20u);
}

}  // namespace
}  // namespace umbrage::render
