#include <gtest/gtest.h>

#include "umbrage/gl/compute.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/gl/debug_log.hpp"
#include "umbrage/gl/pass.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/gl/sample_count.hpp"

namespace umbrage::gl {
namespace {

constexpr int kSize = 16;
// Two triangles that lie over each other, one wound each way, at depth 0.25 and 0.5 (reversed: the second is nearer).
constexpr const char* kVertex = R"(#version 450 core
const vec2 corner[6] = vec2[](vec2(-1, -1), vec2(3, -1), vec2(-1, 3), vec2(-1, -1), vec2(-1, 3), vec2(3, -1));
void main() { gl_Position = vec4(corner[gl_VertexID], gl_VertexID < 3 ? 0.25 : 0.5, 1); })";
constexpr const char* kFragment = R"(#version 450 core
layout(location = 0) out uint id;
void main() { id = uint(gl_PrimitiveID); })";

struct Fixture {
  std::shared_ptr<Context> context;
  static Result<Fixture> make() {
    auto context = Context::createHeadless({.debug = true});
    if (!context) return tl::unexpected(context.error());
    return Fixture{*context};
  }
};

#define NEEDS_GRAPHICS(fixture)                                            \
  const auto fixture = Fixture::make();                                    \
  if (!fixture) GTEST_SKIP() << "no graphics: " << fixture.error().text(); \
  const CurrentContext current(fixture->context);

PassState plain() {
  PassState state;
  state.viewport = {0, 0, kSize, kSize};
  return state;
}

TEST(Context, NamesItsRendererAndLeavesNoneCurrentBehind) {
  const auto context = Context::createHeadless();
  if (!context) GTEST_SKIP() << "no graphics: " << context.error().text();
  EXPECT_FALSE((*context)->renderer().empty());
  EXPECT_GE((*context)->quirks().maxStorageBytes, std::uint64_t{1} << 24);
  const auto second = Context::createHeadless();
  ASSERT_TRUE(second);
  const CurrentContext outer(*context);
  {
    const CurrentContext inner(*second);
    EXPECT_FALSE(currentRenderer().empty());
  }
  EXPECT_EQ(currentRenderer(), (*context)->renderer());
}

TEST(Pass, CountsBothFacesInOneTwoSidedPass) {
  NEEDS_GRAPHICS(fixture);
  const DebugLog log;
  const auto depth = Texture::make(Format::depth32fStencil8, kSize, kSize);
  const auto ids = Texture::make(Format::id32, kSize, kSize);
  ASSERT_TRUE(depth && ids);
  const auto target = Framebuffer::make(&*ids, &*depth);
  ASSERT_TRUE(target);
  const Program program(kVertex, kFragment);
  const VertexArray nothing;
  HostScope scope;
  {
    PassState clear = plain();
    clear.colourWrite = clear.depth.write = true;
    Pass pass(scope, *target, clear);
    pass.clearIds(77);
    pass.clearDepth(0.3f);
    pass.clearStencil(255);
  }
  {
    PassState count = plain();
    count.depth = {.test = true, .pass = Compare::greater};
    count.stencil.test = true;
    count.stencil.front = {.depthFail = StencilOp::increment};
    count.stencil.back = {.pass = StencilOp::increment};
    count.scissor = Rect{0, 0, kSize / 2, kSize};
    Pass pass(scope, *target, count);
    pass.use(program);
    pass.draw(nothing, 6);
  }
  // The front face lies behind 0.3 and the back face before it: both count, 255 wraps around to 1, and only inside the scissor.
  const auto stencil = readStencil(scope, *target, kSize, kSize);
  EXPECT_EQ(stencil(0, 0), 1);
  EXPECT_EQ(stencil(kSize - 1, 0), 255);
  EXPECT_EQ(readIds(scope, *target, kSize, kSize)(0, 0), 77u);
  EXPECT_FLOAT_EQ(readDepth(scope, *target, kSize, kSize)(3, 3), 0.3f);
  EXPECT_TRUE(log.messages().empty()) << log.messages().front();
}

TEST(Pass, NeverPassingStillCountsAsFailed) {
  NEEDS_GRAPHICS(fixture);
  const auto depth = Texture::make(Format::depth32fStencil8, kSize, kSize);
  const auto target = Framebuffer::make(nullptr, &*depth);
  ASSERT_TRUE(target);
  const Program program(kVertex, kFragment);
  const VertexArray nothing;
  HostScope scope;
  PassState state = plain();
  state.depth = {.test = true, .pass = Compare::never, .write = true};
  state.stencil.test = true;
  state.stencil.front = state.stencil.back = {.depthFail = StencilOp::increment};
  {
    Pass pass(scope, *target, state);
    pass.clearDepth(0.0f);
    pass.clearStencil(0);
    pass.use(program);
    pass.draw(nothing, 6);
  }
  EXPECT_EQ(readStencil(scope, *target, kSize, kSize)(5, 5), 2);
}

// A shader writes which triangles are drawn and how many; nothing of it passes through the processor.
TEST(Compute, WritesWhatIsDrawnIndirectly) {
  NEEDS_GRAPHICS(fixture);
  const DebugLog log;
  const Program writer = Program::compute(R"(#version 450 core
layout(local_size_x = 8) in;
layout(std430, binding = 6) writeonly buffer Indices { uint index[]; };
layout(std430, binding = 7) buffer Draws { uint count, instances, first, base, firstInstance; };
void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (i >= 3u) return;
  index[first + i] = 3u + i;
  atomicAdd(count, 1u);
})");
  const auto ids = Texture::make(Format::id32, kSize, kSize);
  ASSERT_TRUE(ids);
  const auto target = Framebuffer::make(&*ids, nullptr);
  ASSERT_TRUE(target);
  const Program program(kVertex, R"(#version 450 core
layout(location = 0) out uint id;
void main() { id = gl_FragCoord.z < 0.4 ? 1u : 2u; })");
  Buffer indices, draws;
  ASSERT_TRUE(indices.reserve(64));
  ASSERT_TRUE(draws.setOne(IndirectDraw{.firstIndex = 4}));
  const VertexArray vertices(indices);
  HostScope scope;
  {
    Compute compute(scope);
    compute.storage(6, indices);
    compute.storage(7, draws);
    compute.use(writer);
    compute.dispatch(3, 8);
    compute.dispatch(0, 8);
  }
  EXPECT_EQ(draws.readAll<IndirectDraw>(1)[0].count, 3u);
  EXPECT_EQ(indices.readAll<std::uint32_t>(7)[6], 5u);
  PassState state = plain();
  state.colourWrite = true;
  {
    Pass pass(scope, *target, state);
    pass.clearIds(0);
    pass.use(program);
    pass.drawIndirect(vertices, draws, 0);
  }
  // Vertices 3 to 5: the triangle at depth 0.5.
  EXPECT_EQ(readIds(scope, *target, kSize, kSize)(2, kSize - 3), 2u);
  EXPECT_TRUE(log.messages().empty()) << log.messages().front();
}

TEST(SampleCount, CountsWhatTrianglesCoverEachByItself) {
  NEEDS_GRAPHICS(fixture);
  const auto depth = Texture::make(Format::depth32fStencil8, kSize, kSize);
  const auto target = Framebuffer::make(nullptr, &*depth);
  ASSERT_TRUE(target);
  const Program program(kVertex, kFragment);
  const VertexArray nothing;
  HostScope scope;
  PassState state = plain();
  state.scissor = Rect{0, 0, 5, kSize};
  SampleCount count(scope);
  {
    Pass pass(scope, *target, state);
    pass.use(program);
    pass.draw(nothing, 6);
  }
  EXPECT_EQ(count.stop(), 2u * 5u * kSize);
}

TEST(ReadBack, PutsTheTopRowFirst) {
  NEEDS_GRAPHICS(fixture);
  const auto ids = Texture::make(Format::id32, kSize, kSize);
  const auto target = Framebuffer::make(&*ids, nullptr);
  ASSERT_TRUE(target);
  HostScope scope;
  PassState state = plain();
  state.colourWrite = true;
  {
    Pass pass(scope, *target, state);
    pass.clearIds(1);
  }
  state.scissor = Rect{0, kSize - 1, 1, 1};
  {
    Pass pass(scope, *target, state);
    pass.clearIds(2);
  }
  const auto picture = readIds(scope, *target, kSize, kSize);
  EXPECT_EQ(picture(0, 0), 2u);
  EXPECT_EQ(picture(0, kSize - 1), 1u);
}

TEST(Texture, RefusesSizesBeyondTheDriver) {
  NEEDS_GRAPHICS(fixture);
  const auto texture = Texture::make(Format::grey8, 1 << 20, 1);
  ASSERT_FALSE(texture);
  EXPECT_EQ(texture.error().code, ErrorCode::device);
}

TEST(PassDeathTest, RefusesToNest) {
  NEEDS_GRAPHICS(fixture);
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto ids = Texture::make(Format::id32, kSize, kSize);
  const auto target = Framebuffer::make(&*ids, nullptr);
  HostScope scope;
  EXPECT_DEATH(
      {
        Pass outer(scope, *target, plain());
        Pass inner(scope, *target, plain());
      },
      "nest");
}

}  // namespace
}  // namespace umbrage::gl
