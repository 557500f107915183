// The judge judged: what is wrong far from every edge must not pass.
#include <gtest/gtest.h>

#include "conformance/judge.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::conformance {
namespace {

using Spoil = std::function<void(shadow::Shading&)>;

// The truth, spoilt.
class Spoilt final : public shadow::Technique {
 public:
  Spoilt(std::unique_ptr<shadow::Technique> truth, Spoil spoil) : truth_(std::move(truth)), spoil_(std::move(spoil)) {}
  const shadow::Traits& traits() const override { return truth_->traits(); }
  Result<void> prepare(std::shared_ptr<const shadow::Geometry> geometry) override {
    return truth_->prepare(std::move(geometry));
  }
  Result<shadow::Shading> shade(const shadow::Frame& frame) override {
    auto shading = truth_->shade(frame);
    if (shading) spoil_(*shading);
    return shading;
  }

 private:
  std::unique_ptr<shadow::Technique> truth_;
  Spoil spoil_;
};

shadow::TechniqueEntry spoilt(const Spoil& spoil) {
  const auto truth = techniques::cpuTechniques().front();
  return {truth.traits, [truth, spoil]() -> Result<std::unique_ptr<shadow::Technique>> {
            return std::make_unique<Spoilt>(std::move(*truth.create()), spoil);
          }};
}

// Whether the surface and its shadow are the same in a square around a pixel.
bool uniform(const shadow::Shading& s, int x, int y, int radius) {
  for (int v = y - radius; v <= y + radius; ++v)
    for (int u = x - radius; u <= x + radius; ++u)
      if (!s.surface.triangle.contains(u, v) || s.surface.triangle(u, v) != s.surface.triangle(x, y) ||
          s.masks[0].light(u, v) != s.masks[0].light(x, y))
        return false;
  return true;
}

class JudgeOf : public testing::TestWithParam<std::string> {};

TEST_P(JudgeOf, SeesEveryWrongPixelOnAnUnbrokenSurface) {
  Case c = makeCase(GetParam());
  const auto geometry = shadow::makeGeometry(c.scene);
  std::size_t expected = 0, flipped = 0;
  const auto entry = spoilt([&](shadow::Shading& s) {
    const shadow::Shading clean = s;
    for (int y = 3; y < s.surface.depth.height(); y += 11) {
      for (int x = 2; x < s.surface.depth.width(); x += 11) {
        expected += uniform(clean, x, y, 3);
        ++flipped;
        s.masks[0].light(x, y) = static_cast<std::uint8_t>(255 - s.masks[0].light(x, y));
      }
    }
  });
  auto judge = Judge::make(entry, geometry);
  ASSERT_TRUE(judge.has_value());
  for (const std::size_t view : {0u, 1u, 2u}) {
    expected = flipped = 0;
    const auto verdicts = judge->judge(c.views[view], {c.lights[0]});
    ASSERT_TRUE(verdicts.has_value());
    const auto& d = verdicts->front().difference;
    EXPECT_EQ(d.differing, flipped);
    EXPECT_GE(d.farFromEdge, expected) << c.views[view].name;
    EXPECT_GT(expected, 20u) << c.views[view].name;
  }
}

TEST_P(JudgeOf, SeesShadowsTwoPixelsOff) {
  Case c = makeCase(GetParam());
  const auto entry = spoilt([](shadow::Shading& s) {
    const image::GreyImage light = s.masks[0].light;
    for (int y = 0; y < light.height(); ++y)
      for (int x = 3; x < light.width(); ++x)
        if (s.masks[0].covered(x, y) != 0) s.masks[0].light(x, y) = light(x - 3, y);
  });
  auto judge = Judge::make(entry, shadow::makeGeometry(c.scene));
  ASSERT_TRUE(judge.has_value());
  const auto verdicts = judge->judge(c.views[0], {c.lights[0]});
  ASSERT_TRUE(verdicts.has_value());
  EXPECT_GT(verdicts->front().difference.farFromEdge, 20u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, JudgeOf, testing::Values("box", "colonnade", "cup", "coplanar_faces"),
                         [](const testing::TestParamInfo<std::string>& row) { return row.param; });

}  // namespace
}  // namespace umbrage::conformance
