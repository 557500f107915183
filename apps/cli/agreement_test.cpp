#include "agreement.hpp"

#include <gtest/gtest.h>

#include "support/shapes.hpp"
#include "umbrage/techniques/cpu/registry.hpp"

namespace umbrage::cli {
namespace {

class CompareMasks : public testing::Test {
 protected:
  void SetUp() override {
    const auto entry = techniques::cpuTechniques().front();
    truth_ = std::move(*entry.create());
    ASSERT_TRUE(truth_->prepare(geometry_));
    camera_.eye = {4, -5, 6}, camera_.target = {0, 0, 0};
    camera_.width = 160, camera_.height = 120;
    right_ = (*truth_->shade(frame())).masks;
  }
  [[nodiscard]] shadow::Frame frame() const { return {camera_, {&light_, 1}}; }
  [[nodiscard]] Agreement compareWith(const std::vector<shadow::LightMask>& masks) const {
    return compareMasks(masks, right_, frame(), 1, shadow::EdgeFinder(geometry_, truth_)).value().front();
  }

  scene::Scene scene_ = scene::withGround(shapes::scene({shapes::box({-1, -1, 0}, {1, 1, 2})}));
  std::shared_ptr<const shadow::Geometry> geometry_ = shadow::makeGeometry(scene_);
  std::shared_ptr<shadow::Technique> truth_;
  scene::Camera camera_;
  scene::Light light_{scene::DirectionalLight{{-1, 0.3, -1}}, Vec3(1.0), 1.0, ""};
  std::vector<shadow::LightMask> right_;
};

TEST_F(CompareMasks, TheSameMaskAgrees) {
  const Agreement a = compareWith(right_);
  EXPECT_TRUE(a.holds());
  EXPECT_EQ(a.differing, 0u);
  EXPECT_GT(a.covered, 10000u);
}

TEST_F(CompareMasks, OneWrongPixelInTheOpenIsEnoughToDisagree) {
  auto wrong = right_;
  wrong[0].light(3, 117) = static_cast<std::uint8_t>(255 - wrong[0].light(3, 117));
  const Agreement a = compareWith(wrong);
  EXPECT_FALSE(a.holds());
  EXPECT_EQ(a.astray, 1u);
}

TEST_F(CompareMasks, WrongPixelsBesideAnEdgeAreForgiven) {
  auto wrong = right_;
  const auto edges = shadow::edgePixels(right_[0]);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      if (edges(x, y) != 0) wrong[0].light(x, y) = static_cast<std::uint8_t>(255 - wrong[0].light(x, y));
  const Agreement a = compareWith(wrong);
  EXPECT_TRUE(a.holds());
  EXPECT_GT(a.differing, 50u);
}

}  // namespace
}  // namespace umbrage::cli
