#include "umbrage/render/veil_lists.hpp"

#include <umbrage_shaders/surface_vert.hpp>
#include <umbrage_shaders/veil_begin_comp.hpp>
#include <umbrage_shaders/veil_frag.hpp>
#include <umbrage_shaders/veil_large_frag.hpp>
#include <umbrage_shaders/veil_place_comp.hpp>
#include <umbrage_shaders/veil_sort_comp.hpp>

#include <algorithm>

#include "umbrage/gl/compute.hpp"
#include "umbrage/gl/quirks.hpp"

namespace umbrage::render {
namespace {

constexpr unsigned kGroup = 64;             // as the shaders have it
constexpr std::size_t kFragmentBytes = 16;  // likewise
constexpr std::size_t kVeilBytes = 8;
constexpr std::size_t kLeastFragments = 1 << 16;

}  // namespace

struct VeilLists::Programs {
  gl::Program ordinary{shaders::kSurfaceVert, shaders::kVeilFrag},
      large{shaders::kSurfaceVert, shaders::kVeilLargeFrag};
  gl::Program begin = gl::Program::compute(shaders::kVeilBeginComp),
              place = gl::Program::compute(shaders::kVeilPlaceComp),
              sort = gl::Program::compute(shaders::kVeilSortComp);
};

VeilLists::VeilLists() = default;
VeilLists::~VeilLists() = default;

Result<void> VeilLists::makeRoom(std::size_t fragments) {
  const std::size_t most = static_cast<std::size_t>(gl::findQuirks().maxStorageBytes) / kFragmentBytes;
  if (fragments > most)
    return fail(ErrorCode::device,
                std::to_string(fragments) +
                    " transparent surfaces before the opaque ones, and a buffer of this driver holds " +
                    std::to_string(most) + "; choose a smaller picture");
  const std::size_t room = std::min(most, std::max(kLeastFragments, fragments + fragments / 4));
  for (const auto& done : {fragments_.reserve(kFragmentBytes * room), veils_.reserve(kVeilBytes * room)})
    if (!done) return done;
  return {};
}

void VeilLists::draw(gl::HostScope& scope, const Input& input) {
  gl::Pass pass(scope, input.frame.tints().bare, input.placement);
  const DrawnTriangles& veils = input.scene.veils();
  pass.uniforms(0, input.view);
  pass.uniforms(1, input.shading);
  pass.storage(0, input.scene.positions());
  pass.storage(2, countsBuffer_);
  pass.storage(3, fragments_);
  pass.storage(4, pixels_);
  pass.texture(0, input.frame.depthStencil());
  pass.use(programs_->ordinary);
  pass.storage(1, veils.ids());
  pass.drawIndexed(veils.vertices(), 0, veils.indexCount());
  pass.use(programs_->large);
  pass.storage(1, veils.largeTriangles());
  pass.drawIndexed(veils.largeVertices(), 0, veils.largeIndexCount());
  pass.publishStorage();
}

void VeilLists::compute(gl::HostScope& scope, const gl::Program& program, std::size_t items) {
  gl::Compute work(scope);
  work.use(program);
  work.storage(2, countsBuffer_);
  work.storage(3, fragments_);
  work.storage(4, pixels_);
  work.storage(5, veils_);
  work.dispatch(items, kGroup);
}

Result<void> VeilLists::find(gl::HostScope& scope, const Input& input) {
  if (programs_ == nullptr) programs_ = std::make_unique<Programs>();
  const std::size_t pixels =
      static_cast<std::size_t>(input.frame.width()) * static_cast<std::size_t>(input.frame.height());
  if (pixels_.bytes() != kVeilBytes * pixels)
    if (auto done = pixels_.set(std::vector<std::byte>(kVeilBytes * pixels)); !done)
      return done;  // shaders ask for its length
  if (auto done = countsBuffer_.reserve(sizeof(Counts)); !done) return done;
  if (auto done = makeRoom(0); !done) return done;
  // Mostly once: again when there are more than ever before.
  for (;;) {
    countsBuffer_.clear();
    pixels_.clear();
    draw(scope, input);
    compute(scope, programs_->begin, pixels);
    countsBuffer_.read(std::as_writable_bytes(std::span(&counts_, 1)));
    if (counts_.fragments * kFragmentBytes <= fragments_.bytes()) break;
    if (auto done = makeRoom(counts_.fragments); !done) return done;
  }
  if (counts_.veils == 0) return {};
  compute(scope, programs_->place, counts_.fragments);
  compute(scope, programs_->sort, pixels);
  return {};
}

}  // namespace umbrage::render
