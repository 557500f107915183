#include "umbrage/render/soft_sums.hpp"

#include <umbrage_shaders/screen_vert.hpp>
#include <umbrage_shaders/soft_add_frag.hpp>
#include <umbrage_shaders/soft_error_frag.hpp>
#include <umbrage_shaders/soft_mean_frag.hpp>

#include <array>
#include <cmath>
#include <limits>

#include "umbrage/gl/quirks.hpp"
#include "umbrage/gl/read_back.hpp"

namespace umbrage::render {
namespace {

constexpr std::size_t kSumBytes = 16;  // as the shaders have it

std::size_t surfacesOf(const TintedFrame& frame) {
  return static_cast<std::size_t>(frame.block.pixelCount) + frame.veils.count();
}

}  // namespace

/// The uniform block Soft of the shaders, as std140 lays it out.
struct SoftSums::Block {
  TintedBlock tinted{};
  Vec4f ball{0.0f, 0.0f, 0.0f, -1.0f}, sample{0.0f};
  std::int32_t half = 0, surfaces = 0;
  std::array<std::int32_t, 2> unused{};
};

struct SoftSums::Programs {
  gl::Program add{shaders::kScreenVert, shaders::kSoftAddFrag}, mean{shaders::kScreenVert, shaders::kSoftMeanFrag},
      error{shaders::kScreenVert, shaders::kSoftErrorFrag};
};

SoftSums::SoftSums() = default;
SoftSums::~SoftSums() = default;

Result<void> SoftSums::setBlock(const TintedFrame& frame, const Block& block) {
  Block whole = block;
  whole.tinted = frame.block;
  whole.surfaces = static_cast<std::int32_t>(surfacesOf(frame));
  return block_.setOne(whole);
}

void SoftSums::bind(gl::Pass& pass, const TintedFrame& frame) const {
  pass.uniforms(0, block_);
  pass.storage(2, frame.veils.pixels());
  pass.storage(3, frame.veils.veils());
  pass.storage(5, halves_);
  pass.texture(0, frame.target.ids());
}

Result<void> SoftSums::add(const TintedFrame& frame, const TintedPasses& passes, const gl::Buffer& shading,
                           const shadow::LightSample& sample, const Vec3& eye) {
  if (programs_ == nullptr) programs_ = std::make_unique<Programs>();
  const std::size_t bytes = 2 * kSumBytes * surfacesOf(frame);
  if (bytes > gl::findQuirks().maxStorageBytes)
    return fail(ErrorCode::device,
                "the picture shows more surfaces than a buffer of this driver holds sums for; choose a smaller one");
  if (auto done = halves_.reserve(bytes); !done) return done;
  if (samples_ == 0) halves_.clear();
  Block block;
  block.half = static_cast<std::int32_t>(shadow::halfOf(samples_));
  if (sample.ball) {
    block.ball = Vec4f(Vec3f(sample.ball->centre - eye), static_cast<float>(sample.ball->radius));
    block.sample = Vec4f(Vec3f(std::get<scene::PointLight>(sample.light.shape).position - eye), 0.0f);
  }
  if (auto done = setBlock(frame, block); !done) return done;
  ++samples_;
  gl::Pass pass(frame.scope, frame.target.stencilTarget(), frame.placement);
  pass.use(programs_->add);
  bind(pass, frame);
  pass.uniforms(1, shading);
  pass.storage(0, passes.faces());
  pass.storage(4, passes.tints());
  pass.draw(screen_, 3);
  pass.publishStorage();
  return {};
}

Result<double> SoftSums::error(const TintedFrame& frame) {
  if (samples_ <= 8) return std::numeric_limits<double>::infinity();
  if (auto done = setBlock(frame, {}); !done) return tl::unexpected(done.error());
  const int columns = tilesFor(frame.target.width()), rows = tilesFor(frame.target.height());
  {
    gl::PassState state;
    state.viewport = {0, 0, columns, rows};
    state.colourWrite = true;
    gl::Pass pass(frame.scope, frame.target.tilesTarget(), state);
    pass.use(programs_->error);
    bind(pass, frame);
    pass.draw(screen_, 3);
  }
  double squares = 0.0, count = 0.0;
  const image::Image<Vec2f> tiles = gl::readPairs(frame.scope, frame.target.tilesTarget(), columns, rows);
  for (const Vec2f& tile : tiles.pixels()) squares += double(tile.x), count += double(tile.y);
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

Result<void> SoftSums::mean(const TintedFrame& frame, const TintedPasses& passes) {
  Block block;
  block.half = samples_ > 8 ? 1 : 0;
  if (auto done = setBlock(frame, block); !done) return done;
  gl::Pass pass(frame.scope, frame.target.stencilTarget(), frame.placement);
  pass.use(programs_->mean);
  bind(pass, frame);
  pass.storage(4, passes.tints());
  pass.draw(screen_, 3);
  pass.publishStorage();
  return {};
}

}  // namespace umbrage::render
