#include "umbrage/gl/pass_state.hpp"

#include <gtest/gtest.h>

namespace umbrage::gl {
namespace {

TEST(PassState, DescribesItselfInOneLine) {
  EXPECT_EQ(describe(PassState{}), "no depth test, clamp");
  PassState state;
  state.depth = {.test = true, .pass = Compare::greater};
  state.stencil.test = true;
  state.stencil.front.depthFail = StencilOp::decrement;
  state.stencil.back.depthFail = StencilOp::increment;
  state.scissor = Rect{1, 2, 3, 4};
  EXPECT_EQ(describe(state), "depth greater, clamp; stencil always, front fail-, back fail+; scissor 3x4 at 1,2");
}

TEST(Rect, IntersectsToEmptyWhenApart) {
  EXPECT_EQ(intersect({0, 0, 10, 10}, {5, 6, 10, 10}), (Rect{5, 6, 5, 4}));
  EXPECT_TRUE(intersect({0, 0, 4, 4}, {4, 0, 4, 4}).empty());
}

}  // namespace
}  // namespace umbrage::gl
