#include "umbrage/render/veil_lists.hpp"

#include <umbrage_shaders/screen_vert.hpp>
#include <umbrage_shaders/surface_vert.hpp>
#include <umbrage_shaders/veil_begin_frag.hpp>
#include <umbrage_shaders/veil_frag.hpp>
#include <umbrage_shaders/veil_large_frag.hpp>
#include <umbrage_shaders/veil_merge_frag.hpp>
#include <umbrage_shaders/veil_place_comp.hpp>
#include <umbrage_shaders/veil_sort_frag.hpp>
#include <umbrage_shaders/volume_frag.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "umbrage/gl/compute.hpp"
#include "umbrage/gl/quirks.hpp"

namespace umbrage::render {
namespace {

// As the shaders have them.
constexpr unsigned kGroup = 64;
constexpr std::size_t kSpilledBytes = 16, kVeilBytes = 8;
constexpr std::size_t kLeast = 1 << 16;
// Places of their own for so many veils of each pixel, where they take no more than so much memory: one counter for all costs processors twice as much as the veils themselves.
constexpr std::size_t kMostSlots = 4, kSlotBytes = std::size_t{64} << 20;
// Runs that are sorted by insertion, where no pixel has more veils than `most`: so that none takes more than 65,535 rounds (veil_merge.frag).
struct Runs {
  std::uint32_t most, run;
};
constexpr std::array kRuns{Runs{256, 256}, Runs{2048, 32}};

std::uint32_t runFor(std::uint32_t most) {
  for (const Runs& r : kRuns)
    if (most <= r.most) return r.run;
  return 1;
}

struct Lists {
  std::int32_t width;
  std::uint32_t slots, run, unused;
};

}  // namespace

struct VeilLists::Programs {
  gl::Program ordinary{shaders::kSurfaceVert, shaders::kVeilFrag},
      large{shaders::kSurfaceVert, shaders::kVeilLargeFrag}, mark{shaders::kSurfaceVert, shaders::kVolumeFrag},
      begin{shaders::kScreenVert, shaders::kVeilBeginFrag}, sort{shaders::kScreenVert, shaders::kVeilSortFrag},
      merge{shaders::kScreenVert, shaders::kVeilMergeFrag};
  gl::Program place = gl::Program::compute(shaders::kVeilPlaceComp);
};

VeilLists::VeilLists() = default;
VeilLists::~VeilLists() = default;

Result<void> VeilLists::makeRoom(const Counts& counts) {
  const auto reserve = [](gl::Buffer& buffer, std::size_t count, std::size_t bytes) -> Result<void> {
    const std::size_t most = static_cast<std::size_t>(gl::findQuirks().maxStorageBytes) / bytes;
    if (count > most)
      return fail(ErrorCode::device,
                  std::to_string(count) +
                      " transparent surfaces before the opaque ones, and a buffer of this driver holds " +
                      std::to_string(most) + "; choose a smaller picture");
    if (bytes * count <= buffer.bytes() && buffer.bytes() > 0) return {};
    return buffer.reserve(bytes * std::min(most, std::max(kLeast, count + count / 4)));
  };
  if (auto done = reserve(veils_, counts.veils, kVeilBytes); !done) return done;
  return reserve(spilled_, counts.spilled, kSpilledBytes);
}

Result<void> VeilLists::setRun(std::uint32_t run) { return lists_.setOne(Lists{width_, slotCount_, run, 0}); }

void VeilLists::draw(gl::HostScope& scope, const Input& input) {
  const DrawnTriangles& veils = input.scene.veils();
  gl::PassState state = input.placement;
  state.depth = {.test = true, .pass = gl::Compare::greater, .write = false, .clamp = true};
  const gl::StencilFace write{.pass = gl::StencilOp::replace};
  state.stencil = {.test = true, .reference = kVeiledBit, .front = write, .back = write};
  gl::Pass pass(scope, input.frame.stencilTarget(), state);
  pass.clearStencil(0);
  pass.uniforms(0, input.view);
  pass.uniforms(2, lists_);
  pass.storage(0, input.scene.positions());
  pass.storage(1, veils.ids());
  pass.storage(2, countsBuffer_);
  pass.storage(3, slots_);
  pass.storage(4, pixels_);
  pass.storage(6, spilled_);
  pass.use(programs_->ordinary);
  pass.drawIndexed(veils.vertices(), 0, veils.indexCount());
  pass.publishStorage();
}

// Their depth is worked out by the shader, which therefore compares it itself; what may have veils is marked whatever its depth.
void VeilLists::drawLarge(gl::HostScope& scope, const Input& input) {
  const DrawnTriangles& veils = input.scene.veils();
  if (veils.largeIndexCount() == 0) return;
  {
    gl::PassState state = input.placement;
    const gl::StencilFace write{.pass = gl::StencilOp::replace};
    state.stencil = {.test = true, .reference = kVeiledBit, .front = write, .back = write};
    gl::Pass pass(scope, input.frame.stencilTarget(), state);
    pass.use(programs_->mark);
    pass.uniforms(0, input.view);
    pass.storage(0, input.scene.positions());
    pass.drawIndexed(veils.largeVertices(), 0, veils.largeIndexCount());
  }
  gl::Pass pass(scope, input.frame.tints().bare, input.placement);
  pass.uniforms(0, input.view);
  pass.uniforms(1, input.shading);
  pass.uniforms(2, lists_);
  pass.storage(0, input.scene.positions());
  pass.storage(1, veils.largeTriangles());
  pass.storage(2, countsBuffer_);
  pass.storage(3, slots_);
  pass.storage(4, pixels_);
  pass.storage(6, spilled_);
  pass.texture(0, input.frame.depthStencil());
  pass.use(programs_->large);
  pass.drawIndexed(veils.largeVertices(), 0, veils.largeIndexCount());
  pass.publishStorage();
}

// Of those that have veils.
void VeilLists::eachPixel(gl::HostScope& scope, const Input& input, const gl::Program& program) {
  gl::PassState state = input.placement;
  state.frontIsClockwise = false;
  state.stencil = {
      .test = true, .compare = gl::Compare::equal, .reference = kVeiledBit, .readMask = kVeiledBit, .writeMask = 0};
  gl::Pass pass(scope, input.frame.stencilTarget(), state);
  pass.use(program);
  pass.uniforms(2, lists_);
  pass.storage(2, countsBuffer_);
  pass.storage(3, &program == &programs_->merge ? merged_ : slots_);
  pass.storage(4, pixels_);
  pass.storage(5, veils_);
  pass.draw(screen_, 3);
  pass.publishStorage();
}

void VeilLists::place(gl::HostScope& scope) {
  gl::Compute work(scope);
  work.use(programs_->place);
  work.storage(2, countsBuffer_);
  work.storage(4, pixels_);
  work.storage(5, veils_);
  work.storage(6, spilled_);
  work.dispatch(counts_.spilled, kGroup);
}

Result<void> VeilLists::sort(gl::HostScope& scope, const Input& input) {
  std::uint32_t run = runFor(counts_.most);
  if (auto done = setRun(run); !done) return done;
  if (run > 1) eachPixel(scope, input, programs_->sort);
  for (; run < counts_.most; run *= 2) {
    for (const auto& done : {setRun(run), merged_.reserve(veils_.bytes())})
      if (!done) return done;
    eachPixel(scope, input, programs_->merge);
    std::swap(veils_, merged_);
  }
  return {};
}

Result<void> VeilLists::find(gl::HostScope& scope, const Input& input) {
  if (programs_ == nullptr) programs_ = std::make_unique<Programs>();
  width_ = input.frame.width();
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(input.frame.height());
  const std::size_t slots = std::clamp<std::size_t>(kSlotBytes / (kVeilBytes * pixels), 1, kMostSlots);
  slotCount_ = static_cast<std::uint32_t>(slots);
  for (const auto& done : {setRun(0), pixels_.reserve(kVeilBytes * pixels), slots_.reserve(kVeilBytes * slots * pixels),
                           countsBuffer_.reserve(sizeof(Counts)), makeRoom({})})
    if (!done) return done;
  // Mostly once: again when there are more than ever before.
  for (;;) {
    countsBuffer_.clear();
    pixels_.clear();
    draw(scope, input);
    drawLarge(scope, input);
    eachPixel(scope, input, programs_->begin);
    countsBuffer_.read(std::as_writable_bytes(std::span(&counts_, 1)));
    if (counts_.spilled * kSpilledBytes <= spilled_.bytes() && counts_.veils * kVeilBytes <= veils_.bytes()) break;
    if (auto done = makeRoom(counts_); !done) return done;
  }
  if (counts_.spilled == 0) return {};
  place(scope);
  return sort(scope, input);
}

}  // namespace umbrage::render
