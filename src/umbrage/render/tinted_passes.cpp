#include "umbrage/render/tinted_passes.hpp"

#include <umbrage_shaders/ambient_frag.hpp>
#include <umbrage_shaders/screen_vert.hpp>
#include <umbrage_shaders/tinted_ambient_frag.hpp>
#include <umbrage_shaders/tinted_encode_frag.hpp>
#include <umbrage_shaders/tinted_farthest_frag.hpp>
#include <umbrage_shaders/tinted_light_frag.hpp>
#include <umbrage_shaders/tinted_lit_frag.hpp>
#include <umbrage_shaders/tinted_lit_veiled_frag.hpp>
#include <umbrage_shaders/tinted_reach_frag.hpp>
#include <umbrage_shaders/tinted_reach_veils_frag.hpp>
#include <umbrage_shaders/tinted_receivers_frag.hpp>
#include <umbrage_shaders/tinted_tiles_frag.hpp>
#include <umbrage_shaders/tinted_tiles_veiled_frag.hpp>
#include <umbrage_shaders/tinted_volume_frag.hpp>
#include <umbrage_shaders/tinted_volume_layers_frag.hpp>
#include <umbrage_shaders/tinted_volume_vert.hpp>
#include <umbrage_shaders/volume_frag.hpp>

#include <bit>

#include "umbrage/gl/quirks.hpp"
#include "umbrage/gl/read_back.hpp"
#include "umbrage/render/detail/tinted_faces.hpp"
#include "umbrage/render/frame_data.hpp"

namespace umbrage::render {
namespace {

constexpr std::size_t kTintBytes = 8;      // as the shaders have it
constexpr std::size_t kVeilSumBytes = 16;  // likewise
// Of the stencil: the highest bit marks where something is to be summed up, the next where there are veils, the others count.
constexpr std::uint8_t kMark = 0x80, kCountBits = 0x3f;
static_assert(kTintedStencil == kCountBits && (kMark | kVeiledBit | kCountBits) == 0xff);

std::vector<std::uint32_t> pattern(std::size_t pieces, std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> indices;
  indices.reserve(pieces * corners.size());
  for (std::uint32_t i = 0; i < pieces; ++i)
    for (const std::uint32_t corner : corners) indices.push_back(4 * i + corner);
  return indices;
}

gl::PassState screenState(const TintedFrame& frame) {
  gl::PassState state = frame.placement;
  state.frontIsClockwise = false;
  return state;
}

gl::StencilState where(std::uint8_t bits, std::uint8_t ofThese, gl::Compare compare = gl::Compare::equal) {
  return {.test = true, .compare = compare, .reference = bits, .readMask = ofThese, .writeMask = 0};
}

// The two parts of a sum, as tinted_volume.vert splits it.
struct Parts {
  std::int32_t upper, lower;
  explicit Parts(std::int32_t sum) : upper((sum + 512) >> 10), lower(sum - upper * 1024) {}
};

std::array<std::array<float, 4>, TintTargets::kPairs> partsOf(const TintWeight& w) {
  const Parts r(w.filter[0]), g(w.filter[1]), b(w.filter[2]);
  const auto pair = [](std::int32_t x, std::int32_t y) {
    return std::array{static_cast<float>(x), static_cast<float>(y), 0.0f, 0.0f};
  };
  return {pair(w.opaque, r.upper), pair(g.upper, b.upper), pair(r.lower, g.lower), pair(b.lower, 0)};
}

}  // namespace

struct TintedPasses::Programs {
  gl::Program receivers{shaders::kScreenVert, shaders::kTintedReceiversFrag},
      tiles{shaders::kScreenVert, shaders::kTintedTilesFrag},
      tilesVeiled{shaders::kScreenVert, shaders::kTintedTilesVeiledFrag},
      volume{shaders::kTintedVolumeVert, shaders::kTintedVolumeFrag},
      volumeCount{shaders::kTintedVolumeVert, shaders::kVolumeFrag},
      volumeLayers{shaders::kTintedVolumeVert, shaders::kTintedVolumeLayersFrag},
      farthest{shaders::kScreenVert, shaders::kTintedFarthestFrag},
      reach{shaders::kScreenVert, shaders::kTintedReachFrag},
      reachVeils{shaders::kScreenVert, shaders::kTintedReachVeilsFrag},
      ambient{shaders::kScreenVert, shaders::kAmbientFrag},
      ambientVeiled{shaders::kScreenVert, shaders::kTintedAmbientFrag},
      lit{shaders::kScreenVert, shaders::kTintedLitFrag},
      litVeiled{shaders::kScreenVert, shaders::kTintedLitVeiledFrag},
      light{shaders::kScreenVert, shaders::kTintedLightFrag}, encode{shaders::kScreenVert, shaders::kTintedEncodeFrag};
};

TintedPasses::TintedPasses() : programs_(std::make_unique<Programs>()) {}
TintedPasses::~TintedPasses() = default;

Result<std::unique_ptr<TintedPasses>> TintedPasses::make(const shadow::Geometry& geometry) {
  std::unique_ptr<TintedPasses> passes(new TintedPasses);
  const std::vector<detail::Face> faces = detail::facesOf(geometry);
  if (auto done = setStorage(passes->faces_, std::as_bytes(std::span(faces)), "triangles"); !done)
    return tl::unexpected(done.error());
  return passes;
}

Result<void> TintedPasses::setMaterials(std::span<const scene::Material> materials) {
  return materials_.setAll(materialRows(materials));
}

Result<void> TintedPasses::setBlock(const TintedFrame& frame, int light, Toward toward) {
  TintedBlock block = frame.block;
  block.light = light;
  block.hasSums = !byStencil_ || hasTinted_ ? 1 : 0;
  block.isFirst = toward == Toward::newPicture ? 1 : 0;
  block.atEye = atEye_;
  if (auto done = block_.setOne(block); !done) return done;
  block.opaqueDark = 1;
  return darkBlock_.setOne(block);
}

Result<void> TintedPasses::setLight(const TintedFrame& frame, const TintedLight& light,
                                    std::span<const std::uint8_t> facing, std::span<const std::int8_t> side) {
  const auto surfaces = static_cast<std::size_t>(frame.block.pixelCount) + frame.veils.count();
  if (kTintBytes * surfaces > gl::findQuirks().maxStorageBytes)
    return fail(ErrorCode::device, "the picture shows more surfaces than a buffer of this driver holds tints for");
  for (const auto& done : {view_.setOne(light.view), shading_.setOne(light.shading),
                           bits_.setAll(detail::packLightBits(facing, side)), tints_.reserve(kTintBytes * surfaces),
                           veilSums_.reserve(frame.lightsVeils() ? kVeilSumBytes * frame.veils.count() : 0)})
    if (!done) return done;
  for (std::size_t i = 0; i < counted_.size(); ++i)
    if (auto done =
            counted_[i].setOne(std::array{static_cast<std::int32_t>(i % kAllCounted.size()), frame.block.litLayers,
                                          frame.block.width, i < kAllCounted.size() ? 1 : 0});
        !done)
      return done;
  return {};
}

Result<image::Image<Vec2f>> TintedPasses::receivers(const TintedFrame& frame) {
  const int columns = tilesFor(frame.target.width()), rows = tilesFor(frame.target.height());
  if (auto done = setBlock(frame, 0, Toward::tints); !done) return tl::unexpected(done.error());
  {
    gl::PassState state;
    state.viewport = {0, 0, columns, rows};
    state.colourWrite = true;
    gl::Pass pass(frame.scope, frame.target.tilesTarget(), state);
    pass.use(frame.lightsVeils() ? programs_->tilesVeiled : programs_->tiles);
    pass.uniforms(0, block_);
    pass.storage(1, bits_);
    if (frame.lightsVeils()) {
      pass.storage(2, frame.veils.pixels());
      pass.storage(3, frame.veils.veils());
    }
    pass.texture(0, frame.target.ids());
    pass.texture(1, frame.target.depthStencil());
    pass.draw(screen_, 3);
  }
  return gl::readPairs(frame.scope, frame.target.tilesTarget(), columns, rows);
}

Result<void> TintedPasses::setPatterns(std::size_t pieces) {
  if (pieces <= patterns_) return {};
  patterns_ = pieces + pieces / 4;
  constexpr std::array<std::uint32_t, 6> kSide{0, 1, 2, 0, 2, 3};
  if (auto done = quads_.setAll(pattern(patterns_, kSide)); !done) return done;
  return triangles_.setAll(pattern(patterns_, std::span(kSide).first(3)));
}

Result<void> TintedPasses::setVolume(const TintedVolume& volume) {
  passSides_ = volume.passSides, passCaps_ = volume.passCaps;
  failSides_ = volume.failSides, failCaps_ = volume.failCaps;
  atEye_ = volume.atEye;
  byStencil_ = volume.fitsStencil;
  hasTinted_ = volume.hasTinted();
  for (const auto& done : {setStorage(pieces_, std::as_bytes(std::span(volume.pieces)), "sides of shadow volumes"),
                           farPoints_.setAll(volume.farPoints), setPatterns(volume.pieces.size())})
    if (!done) return done;
  return {};
}

// The sums start from what is there at the eye.
void TintedPasses::begin(const TintedFrame& frame, const TintedLight& light) {
  gl::PassState state = screenState(frame);
  TintWeight start = atEye_;
  if (byStencil_) start.opaque = 0;
  if (!byStencil_ || hasTinted_) {
    state.colourWrite = true;
    state.colourTargets = static_cast<int>(TintTargets::kPairs);
    state.scissor = light.litArea;
    gl::Pass pass(frame.scope, frame.target.tints().opaque, state);
    const auto parts = partsOf(start);
    for (int i = 0; i < state.colourTargets; ++i) pass.clearColour(parts[static_cast<std::size_t>(i)], i);
  }
  gl::PassState counts = screenState(frame);
  if (frame.veils.count() > 0) counts.stencil.writeMask = kMark | kCountBits;
  gl::Pass pass(frame.scope, frame.target.stencilTarget(), counts);
  pass.clearStencil(byStencil_ ? static_cast<std::uint8_t>(atEye_.opaque & kCountBits) : 0);
}

// Where a surface may be lit: there alone anything is summed up and written.
void TintedPasses::mark(const TintedFrame& frame, const TintedLight& light) {
  gl::PassState state = screenState(frame);
  const gl::StencilFace write{.pass = gl::StencilOp::replace};
  state.stencil = {.test = true, .reference = kMark, .writeMask = kMark, .front = write, .back = write};
  state.scissor = light.litArea;
  gl::Pass pass(frame.scope, frame.target.stencilTarget(), state);
  pass.use(programs_->receivers);
  pass.storage(1, bits_);
  pass.texture(0, frame.target.ids());
  pass.draw(screen_, 3);
}

void TintedPasses::drawPieces(gl::Pass& pass, const TintedFrame& frame, const IndexRange& sides,
                              const IndexRange& caps) {
  pass.uniforms(0, view_);
  pass.storage(0, frame.scene.positions());
  pass.storage(1, farPoints_);
  pass.storage(2, pieces_);
  if (sides.count > 0) pass.drawIndexed(quadVertices_, 6 * sides.first, 6 * sides.count);
  if (caps.count > 0) pass.drawIndexed(triangleVertices_, 3 * caps.first, 3 * caps.count);
}

// In the lower bits, as all stencil volumes are. What counts behind is told by its turned comparison.
void TintedPasses::countOpaque(const TintedFrame& frame, const gl::Rect& area, Counted counted) {
  const IndexRange sides =
      counted == everywhere ? IndexRange{} : (counted == behind ? failSides_ : passSides_).ofOpaque();
  const IndexRange caps = counted == behind ? IndexRange{} : (counted == before ? passCaps_ : failCaps_).ofOpaque();
  if (sides.count + caps.count == 0) return;
  const gl::StencilFace up{.pass = gl::StencilOp::increment}, down{.pass = gl::StencilOp::decrement};
  gl::PassState state = frame.placement;
  const auto compare = counted == before ? gl::Compare::greater : gl::Compare::lessOrEqual;
  state.depth = {.test = counted != everywhere, .pass = compare, .write = false, .clamp = true};
  state.stencil = {.test = true,
                   .compare = gl::Compare::equal,
                   .reference = kMark,
                   .readMask = kMark,
                   .writeMask = kCountBits,
                   .front = counted == before ? up : down,
                   .back = counted == before ? down : up};
  state.scissor = area;
  gl::Pass pass(frame.scope, frame.target.stencilTarget(), state);
  pass.use(programs_->volumeCount);
  drawPieces(pass, frame, sides, caps);
}

void TintedPasses::addTinted(const TintedFrame& frame, const gl::Rect& area, Counted counted) {
  const auto range = [&](const PieceRange& pieces) { return byStencil_ ? pieces.ofTinted() : pieces.all(); };
  const IndexRange sides = counted == everywhere ? IndexRange{} : range(counted == behind ? failSides_ : passSides_);
  const IndexRange caps = counted == behind ? IndexRange{} : range(counted == before ? passCaps_ : failCaps_);
  if (sides.count + caps.count == 0) return;
  gl::PassState state = frame.placement;
  const auto compare = counted == before ? gl::Compare::greater : gl::Compare::lessOrEqual;
  state.depth = {.test = counted != everywhere, .pass = compare, .write = false, .clamp = true};
  // What opaque casters have darkened already stays dark.
  state.stencil = where(kMark, kMark | kCountBits);
  state.blend = gl::Blend::add;
  state.colourWrite = true;
  state.colourTargets = static_cast<int>(TintTargets::kPairs);
  state.scissor = area;
  gl::Pass pass(frame.scope, frame.target.tints().opaque, state);
  pass.use(programs_->volume);
  drawPieces(pass, frame, sides, caps);
}

void TintedPasses::findFarthest(const TintedFrame& frame, const gl::Rect& area) {
  gl::PassState state = screenState(frame);
  state.depth = {.test = true, .pass = gl::Compare::always, .write = true, .clamp = true};
  state.scissor = area;
  gl::Pass pass(frame.scope, frame.target.tints().veils, state);
  pass.use(programs_->farthest);
  pass.uniforms(0, block_);
  pass.storage(2, frame.veils.pixels());
  pass.storage(3, frame.veils.veils());
  pass.draw(screen_, 3);
}

void TintedPasses::addToVeils(const TintedFrame& frame, const gl::Rect& area, Counted counted) {
  const PieceRange& sides = counted == behind ? failSides_ : passSides_;
  const PieceRange& caps = counted == before ? passCaps_ : failCaps_;
  gl::PassState state = frame.placement;
  // What is behind the farthest veil is before none.
  state.depth = {.test = counted == before, .pass = gl::Compare::greater, .write = false, .clamp = true};
  if (counted != before) state.stencil = where(kVeiledBit, kVeiledBit);
  state.scissor = area;
  gl::Pass pass(frame.scope, counted == before ? frame.target.tints().veils : frame.target.stencilTarget(), state);
  pass.use(programs_->volumeLayers);
  pass.storage(3, frame.veils.pixels());
  pass.storage(4, frame.veils.veils());
  pass.storage(5, veilSums_);
  const auto draw = [&](const IndexRange& s, const IndexRange& c, std::size_t place) {
    pass.uniforms(1, counted_[place + counted]);
    drawPieces(pass, frame, counted == everywhere ? IndexRange{} : s, counted == behind ? IndexRange{} : c);
  };
  draw(sides.ofOpaque(), caps.ofOpaque(), 0);
  draw(sides.ofTinted(), caps.ofTinted(), kAllCounted.size());
  pass.publishStorage();
}

void TintedPasses::sum(const TintedFrame& frame, const TintedLight& light) {
  const gl::Rect area = gl::intersect(light.volumeArea, light.litArea);
  begin(frame, light);
  if (light.litArea.empty()) return;
  mark(frame, light);
  if (area.empty()) return;
  if (byStencil_)
    for (const Counted counted : kAllCounted) countOpaque(frame, area, counted);
  for (const Counted counted : kAllCounted) addTinted(frame, area, counted);
}

void TintedPasses::sumVeils(const TintedFrame& frame, const TintedLight& light) {
  veilSums_.clear();
  const gl::Rect area = gl::intersect(light.volumeArea, light.litArea);
  if (area.empty()) return;
  if (passSides_.all().count + passCaps_.all().count > 0) findFarthest(frame, area);
  for (const Counted counted : kAllCounted) addToVeils(frame, area, counted);
}

bool TintedPasses::countsOpaque() const {
  return byStencil_ && passSides_.opaque + passCaps_.opaque + failSides_.opaque + failCaps_.opaque +
                               static_cast<std::size_t>(atEye_.opaque != 0) >
                           0;
}

// All that shaders ask of surfaces and sums, but the block.
void TintedPasses::bindSurfaces(gl::Pass& pass, const TintedFrame& frame) {
  pass.uniforms(1, shading_);
  pass.storage(0, faces_);
  pass.storage(1, bits_);
  pass.storage(2, frame.veils.pixels());
  pass.storage(3, frame.veils.veils());
  pass.texture(0, frame.target.ids());
  const auto& sums = frame.target.tints().sums;
  for (unsigned i = 0; i < sums.size(); ++i) pass.texture(1 + i, sums[i]);
}

// draw(where, block): pixels with veils, by what becomes of their opaque surfaces: those that are marked alone may be lit; what opaque casters have darkened is not marked alone any more.
template <class Draw>
void TintedPasses::forEachVeiled(const Draw& draw) {
  draw(where(kMark | kVeiledBit, 0xff), block_);
  draw(where(kVeiledBit, kMark | kVeiledBit), darkBlock_);
  if (countsOpaque()) draw(where(kMark | kVeiledBit, 0xff, gl::Compare::less), darkBlock_);
}

void TintedPasses::writeTints(const TintedFrame& frame, const TintedLight& light) {
  tints_.clear();
  if (light.litArea.empty()) return;
  const auto draw = [&](const gl::Program& program, const gl::StencilState& where, const gl::Buffer& block) {
    gl::PassState state = screenState(frame);
    state.stencil = where;
    state.scissor = light.litArea;
    gl::Pass pass(frame.scope, frame.target.stencilTarget(), state);
    pass.use(program);
    pass.uniforms(0, block);
    bindSurfaces(pass, frame);
    pass.storage(4, tints_);
    pass.storage(5, veilSums_);
    pass.draw(screen_, 3);
    pass.publishStorage();
  };
  draw(programs_->reach, where(kMark, 0xff), block_);
  if (frame.veils.count() > 0)
    forEachVeiled(
        [&](const gl::StencilState& where, const gl::Buffer& block) { draw(programs_->reachVeils, where, block); });
}

// Of the surfaces that nothing is before.
void TintedPasses::addAmbient(const TintedFrame& frame, const gl::Buffer& shading, const gl::StencilState& where) {
  gl::PassState state = screenState(frame);
  state.colourWrite = true;
  state.stencil = where;
  gl::Pass pass(frame.scope, frame.target.sumTarget(), state);
  pass.use(programs_->ambient);
  pass.uniforms(1, shading);
  pass.storage(1, frame.scene.triangles());
  pass.storage(2, frame.scene.corners());
  pass.storage(4, materials_);
  pass.texture(0, frame.target.ids());
  pass.draw(screen_, 3);
}

// A new picture has ambient light alone where nothing else arrives; what of that is drawn where there are veils is drawn over.
void TintedPasses::addLit(const TintedFrame& frame, const TintedLight& light, Toward toward) {
  const bool isNew = toward == Toward::newPicture;
  if (isNew) {
    gl::PassState state = screenState(frame);
    state.colourWrite = true;
    gl::Pass(frame.scope, frame.target.sumTarget(), state).clearColour({0.0f, 0.0f, 0.0f, 0.0f});
    addAmbient(frame, shading_, where(0, kMark | kVeiledBit));
    if (countsOpaque()) addAmbient(frame, shading_, where(kMark, kMark | kCountBits, gl::Compare::less));
  }
  const auto draw = [&](const gl::Program& program, const gl::StencilState& where, const gl::Buffer& block) {
    gl::PassState state = screenState(frame);
    state.stencil = where;
    if (!isNew) state.scissor = light.litArea;
    state.colourWrite = true;
    state.blend = isNew ? gl::Blend::off : gl::Blend::add;
    gl::Pass pass(frame.scope, frame.target.sumTarget(), state);
    pass.use(program);
    pass.uniforms(0, block);
    bindSurfaces(pass, frame);
    pass.storage(4, veilSums_);
    pass.storage(5, materials_);
    pass.draw(screen_, 3);
    pass.publishStorage();  // nothing is written; but llvmpipe draws later, from buffers that the next light has filled anew
  };
  draw(programs_->lit, where(kMark, 0xff), block_);
  if (frame.veils.count() > 0)
    forEachVeiled(
        [&](const gl::StencilState& where, const gl::Buffer& block) { draw(programs_->litVeiled, where, block); });
}

Result<void> TintedPasses::reach(const TintedFrame& frame, const TintedLight& light, Toward toward,
                                 const PhaseEnd& ended) {
  const auto end = [&](const char* phase) {
    if (!ended) return;
    gl::finish();
    ended(phase);
  };
  if (auto done = setBlock(frame, light.number, toward); !done) return done;
  if (frame.lightsVeils()) {
    sumVeils(frame, light);
    end("volumes at veils");
  }
  sum(frame, light);
  end("volumes");
  if (toward == Toward::tints)
    writeTints(frame, light);
  else if (!light.litArea.empty() || toward == Toward::newPicture)
    addLit(frame, light, toward);
  end("lit");
  return {};
}

Result<void> TintedPasses::beginPicture(const TintedFrame& frame, const gl::Buffer& shading) {
  if (auto done = setBlock(frame, 0, Toward::tints); !done) return done;
  gl::PassState state = screenState(frame);
  state.colourWrite = true;
  gl::Pass(frame.scope, frame.target.sumTarget(), state).clearColour({0.0f, 0.0f, 0.0f, 0.0f});
  if (frame.veils.count() == 0) {
    addAmbient(frame, shading, {});
    return {};
  }
  addAmbient(frame, shading, where(0, kVeiledBit));
  state.stencil = where(kVeiledBit, kVeiledBit);
  gl::Pass pass(frame.scope, frame.target.sumTarget(), state);
  pass.use(programs_->ambientVeiled);
  pass.uniforms(0, block_);
  pass.uniforms(1, shading);
  pass.storage(0, faces_);
  pass.storage(2, frame.veils.pixels());
  pass.storage(3, frame.veils.veils());
  pass.storage(5, materials_);
  pass.texture(0, frame.target.ids());
  pass.draw(screen_, 3);
  return {};
}

Result<void> TintedPasses::addLight(const TintedFrame& frame, int light) {
  if (auto done = setBlock(frame, light, Toward::tints); !done) return done;
  gl::PassState state = screenState(frame);
  state.colourWrite = true;
  state.blend = gl::Blend::add;
  gl::Pass pass(frame.scope, frame.target.sumTarget(), state);
  pass.use(programs_->light);
  pass.uniforms(0, block_);
  bindSurfaces(pass, frame);
  pass.storage(4, tints_);
  pass.storage(5, materials_);
  pass.draw(screen_, 3);
  pass.publishStorage();  // as addLit() does
  return {};
}

void TintedPasses::endPicture(const TintedFrame& frame, const gl::Buffer& shading) {
  gl::PassState state = screenState(frame);
  state.colourWrite = true;
  gl::Pass pass(frame.scope, frame.target.pictureTarget(), state);
  pass.use(programs_->encode);
  pass.uniforms(1, shading);
  pass.texture(1, frame.target.sum());
  pass.draw(screen_, 3);
}

}  // namespace umbrage::render
