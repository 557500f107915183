// Shadows whose borders are known in closed form: measured in every technique's masks to a pixel, and by single rays as sharply as
// single precision allows.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "conformance/judge.hpp"
#include "support/shapes.hpp"
#include "umbrage/trace/light_rays.hpp"

namespace umbrage::conformance {
namespace {

scene::Light sunFrom(Angle elevation, Angle turn) {
  const Vec3 travels(cos(elevation) * cos(turn), cos(elevation) * sin(turn), -sin(elevation));
  return {scene::DirectionalLight{travels}, Vec3(1.0), 1.0, ""};
}
scene::Light lamp(const Vec3& at) { return {scene::PointLight{at}, Vec3(1.0), 1.0, ""}; }

/// The scene from straight above: pixel columns run along +x, rows along -y.
scene::Camera overhead(const Vec3& centre, double width) {
  scene::Camera c = looking(centre + Vec3(0, 0, 50), centre, 45, 400, 400);
  c.up = {0, 1, 0};
  c.fovY = Angle::radians(2.0 * std::atan(0.5 * width / 50));
  return c;
}

// Where a pixel's centre meets the ground z = 0, in pixels per unit and back.
struct Ground {
  scene::Camera camera;
  [[nodiscard]] Vec3 at(int x, int y) const {
    const Vec3 ray = scene::pixelRays(camera).through(x + 0.5, y + 0.5);
    return camera.eye - camera.eye.z / ray.z * ray;
  }
  [[nodiscard]] double pixel() const { return glm::length(at(1, 0) - at(0, 0)); }
};

/// Whether a point of the ground lies in shadow by the closed form, and how far it is from the border of that region (a lower
/// bound suffices).
struct Expected {
  bool dark = false;
  double toBorder = 0.0;
};

// Every ground pixel of every technique more than a pixel from the closed form's border must agree with it.
void compareMasks(const scene::Scene& s, const scene::Light& light, const Vec3& centre, double width,
                  const std::function<Expected(const Vec3&)>& expected) {
  const Ground ground{overhead(centre, width)};
  const auto geometry = shadow::makeGeometry(s);
  for (const auto& entry : allTechniques()) {
    auto technique = entry.create();
    if (!technique) {
      ASSERT_EQ(technique.error().code, ErrorCode::device);
      continue;
    }
    ASSERT_TRUE((*technique)->prepare(geometry));
    const auto shading = (*technique)->shade({ground.camera, {&light, 1}});
    ASSERT_TRUE(shading.has_value());
    std::size_t dark = 0, wrong = 0;
    for (int y = 0; y < ground.camera.height; ++y) {
      for (int x = 0; x < ground.camera.width; ++x) {
        const std::uint32_t t = shading->surface.triangle(x, y);
        if (t == shadow::kNoTriangle || geometry->surfaces.casts[t] != 0) continue;
        const Expected e = expected(ground.at(x, y));
        dark += e.dark;
        wrong += e.toBorder > ground.pixel() && (shading->masks[0].light(x, y) == 0) != e.dark;
      }
    }
    EXPECT_GT(dark, 1000u) << entry.traits.name;
    EXPECT_EQ(wrong, 0u) << entry.traits.name;
  }
}

// The point between `inside` and `outside` on the ground where shadow changes, by halving with single rays.
double borderBetween(const trace::Occlusion& occlusion, const scene::Light& light, const Vec3& inside,
                     const Vec3& outside) {
  const trace::LightRays rays(occlusion, light);
  const auto hidden = [&](double s) {
    trace::SurfacePoints8 points;
    points.active = 1;
    points.position.set(0, inside + s * (outside - inside));
    points.normal.set(0, {0, 0, 1});
    points.triangle[0] = shadow::kNoTriangle;
    points.precision[0] = 0.0;
    points.reach[0] = 0.0;
    return rays.hidden(points) != 0;
  };
  EXPECT_NE(hidden(0.0), hidden(1.0));
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i) (hidden(0.5 * (low + high)) == hidden(0.0) ? low : high) = 0.5 * (low + high);
  return low * glm::length(outside - inside);
}

trace::Occlusion occlusionOf(const scene::Scene& s) {
  return std::move(*trace::Occlusion::build(std::make_shared<scene::Surfaces>(scene::flatten(s))));
}

scene::Scene onGround(std::vector<mesh::Mesh> meshes) {
  return scene::withGround(shapes::scene(std::move(meshes)), 0.0);
}

Expected insideRectangle(const Vec3& p, double x0, double x1, double y0, double y1) {
  const double d = std::min({p.x - x0, x1 - p.x, p.y - y0, y1 - p.y});
  if (d >= 0.0) return {true, d};
  return {false, std::hypot(std::max({x0 - p.x, 0.0, p.x - x1}), std::max({y0 - p.y, 0.0, p.y - y1}))};
}

TEST(ClosedForm, ABoxOfHeightHCastsHOverTanElevation) {
  constexpr double kHeight = 2.0;
  const auto s = onGround({shapes::box({-1, -1, 0}, {1, 1, kHeight})});
  const auto occlusion = occlusionOf(s);
  for (const double degrees : {15.0, 30.0, 45.0, 60.0, 80.0}) {
    const Angle a = Angle::degrees(degrees);
    const double length = kHeight / tan(a);
    const scene::Light light = sunFrom(a, Angle());
    // From the wall x = 1 along +x.
    const double measured = borderBetween(occlusion, light, {1 + 0.5 * length, 0.3, 0}, {1 + 2 * length, 0.3, 0});
    EXPECT_NEAR(0.5 * length + measured, length, 1e-6 * length / sin(a)) << degrees;
    compareMasks(s, light, {1 + 0.5 * length, 0, 0}, 4 + 1.5 * length,
                 [&](const Vec3& p) { return insideRectangle(p, -1, 1 + length, -1, 1); });
  }
}

TEST(ClosedForm, TheEdgeOfAHalfPlaneFallsWhereTheRayThroughItDoes) {
  const double edge = 0.25, height = 3.0;
  const auto s =
      onGround({shapes::quad({-900, -900, height}, {edge, -900, height}, {edge, 900, height}, {-900, 900, height})});
  const Vec3 at(-2, 1, 9);
  const double border = at.x + (edge - at.x) * at.z / (at.z - height);
  const auto occlusion = occlusionOf(s);
  EXPECT_NEAR(borderBetween(occlusion, lamp(at), {border - 1, 5, 0}, {border + 1, 5, 0}), 1.0, 900e-6);
  // From below the sheet one would see nothing of the ground; from above, only what lies beyond its edge.
  compareMasks(s, lamp(at), {border, 0, 0}, 8, [&](const Vec3& p) {
    return Expected{p.x < border, std::abs(p.x - border)};
  });
}

TEST(ClosedForm, ASphereCastsAnEllipse) {
  constexpr double kRadius = 1.5, kHeight = 2.5;
  constexpr int kColumns = 384, kRows = 192;
  const auto s = onGround({shapes::sphere({0, 0, kHeight}, kRadius, kColumns, kRows)});
  // The mesh is inscribed: its silhouette is at most this far inside the sphere's.
  const double sagitta = kRadius * (1 - std::cos(std::numbers::pi / kRows)) * 2;
  const auto occlusion = occlusionOf(s);
  for (const double degrees : {25.0, 50.0, 75.0}) {
    const Angle a = Angle::degrees(degrees);
    const scene::Light light = sunFrom(a, Angle());
    const Vec3 centre(kHeight / tan(a), 0, 0);
    const double along = kRadius / sin(a);
    EXPECT_NEAR(borderBetween(occlusion, light, centre, centre + Vec3(2 * along, 0, 0)), along,
                sagitta / sin(a) + 1e-5);
    EXPECT_NEAR(borderBetween(occlusion, light, centre, centre + Vec3(0, 3 * kRadius, 0)), kRadius, sagitta + 1e-5);
    compareMasks(s, light, centre, 3 * along, [&](const Vec3& p) {
      const double r = std::hypot((p.x - centre.x) / along, (p.y - centre.y) / kRadius);
      return Expected{r < 1.0, kRadius * std::abs(r - 1.0) - sagitta / sin(a)};
    });
  }
}

TEST(ClosedForm, ALampOverASquareEnlargesItBySimilarTriangles) {
  constexpr double kSide = 1.0, kHeight = 2.0, kLamp = 5.0;
  const auto s =
      onGround({shapes::quad({-0.5, -0.5, kHeight}, {0.5, -0.5, kHeight}, {0.5, 0.5, kHeight}, {-0.5, 0.5, kHeight})});
  const double half = 0.5 * kSide * kLamp / (kLamp - kHeight);
  const scene::Light light = lamp({0, 0, kLamp});
  const auto occlusion = occlusionOf(s);
  EXPECT_NEAR(borderBetween(occlusion, light, {0.01, 0.02, 0}, {2, 0.02, 0}) + 0.01, half, 1e-5);
  compareMasks(s, light, {0, 0, 0}, 4, [&](const Vec3& p) { return insideRectangle(p, -half, half, -half, half); });
}

TEST(ClosedForm, ASpotLightsACircle) {
  constexpr double kLamp = 4.0;
  const Angle cutoff = Angle::degrees(20);
  const scene::Light light{scene::SpotLight{{0.5, -0.25, kLamp}, {0, 0, -2}, cutoff}, Vec3(1.0), 1.0, ""};
  const double radius = kLamp * tan(cutoff);
  // A caster far below the circle's plane, so that there is something to prepare.
  const auto s = onGround({shapes::box({30, 30, 0}, {31, 31, 1})});
  compareMasks(s, light, {0.5, -0.25, 0}, 5, [&](const Vec3& p) {
    const double r = std::hypot(p.x - 0.5, p.y + 0.25);
    return Expected{r > radius, std::abs(r - radius)};
  });
}

}  // namespace
}  // namespace umbrage::conformance
