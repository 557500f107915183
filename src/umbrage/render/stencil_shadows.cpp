#include "umbrage/render/stencil_shadows.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/context.hpp"
#include "umbrage/render/depth_bounds.hpp"
#include "umbrage/render/uniforms.hpp"

namespace umbrage::render {
namespace {

/// A part of a caster's volume, and how it is counted.
struct Member {
  const StoredVolume* volume;
  const VolumePart* part;
  const gl::Buffer* positions;
  const PlaceData* place;
  bool mirrored;
  bool byZFail;
  int eyeCount;
  std::vector<IndexRange> sides;  ///< those that are drawn
  const gl::VertexArray* capVertices;
  IndexRange caps;
};

/// Members that are counted together.
struct Group {
  std::vector<Member> members;
  int layers = 0;

  [[nodiscard]] GroupPlan plan() const {
    GroupPlan plan;
    for (const Member& m : members) {
      plan.eyeCount += m.eyeCount;
      (m.byZFail ? plan.failSides : plan.passSides) |= !m.sides.empty();
      plan.failCaps |= m.byZFail && m.caps.count > 0;
    }
    return plan;
  }
};

// First fit; one group of them all when it may be counted with all eight bits.
std::vector<Group> grouped(std::vector<Member>&& members) {
  int layers = 0;
  for (const Member& m : members) layers += m.part->layers;
  std::vector<Group> groups(1);
  if (layers <= kWholeStencil) {
    groups[0] = {std::move(members), layers};
    return groups;
  }
  for (Member& m : members) {
    const auto fits = [&](const Group& g) { return g.layers + m.part->layers <= kSharedStencil; };
    auto group = std::find_if(groups.begin(), groups.end(), fits);
    if (group == groups.end()) group = groups.insert(groups.end(), Group{});
    group->layers += m.part->layers;
    group->members.push_back(m);
  }
  return groups;
}

View viewFrom(const PosedCasters& posed, const View& world) {
  View view = world;
  view.toClip = world.toClip * Mat4(Mat3(posed.toWorld));
  view.eye = posed.casters->origin + pointFrom(posed, world.eye);
  return view;
}

// The parts of a member's volume that a step draws; none when it is not for this member.
std::vector<IndexRange> rangesFor(Draw draw, const Member& m) {
  if (draw == Draw::passSides && !m.byZFail) return m.sides;
  if (draw == Draw::failSides && m.byZFail) return m.sides;
  if (draw == Draw::failCaps && m.byZFail && m.caps.count > 0) return {m.caps};
  return {};
}

void drawMembers(gl::HostScope& scope, const PassStep& step, const Group& group, bool mirrored,
                 const gl::Program& program) {
  const auto drawn = [&](const Member& m) { return m.mirrored == mirrored && !rangesFor(step.draw, m).empty(); };
  if (std::none_of(group.members.begin(), group.members.end(), drawn)) return;
  gl::PassState state = step.state;
  state.frontIsClockwise = state.frontIsClockwise != mirrored;
  gl::Pass pass(scope, scope.hostFramebuffer(), state);
  pass.use(program);
  for (const Member& m : group.members) {
    if (!drawn(m)) continue;
    pass.uniforms(0, m.place->view);
    pass.storage(0, *m.positions);
    if (step.shader == Shader::finiteVolume) pass.storage(1, m.place->farPoints);
    const gl::VertexArray& vertices = step.draw == Draw::failCaps ? *m.capVertices : m.volume->vertices;
    for (const IndexRange& range : rangesFor(step.draw, m)) pass.drawIndexed(vertices, range.first, range.count);
  }
}

void runStep(gl::HostScope& scope, const PassStep& step, const std::vector<Group>& groups, Programs& programs,
             const gl::VertexArray& nothing) {
  if (step.draw == Draw::nothing || step.draw == Draw::screen) {
    gl::Pass pass(scope, scope.hostFramebuffer(), step.state);
    if (step.clearStencil) pass.clearStencil(*step.clearStencil);
    if (step.draw == Draw::nothing) return;
    pass.use(programs.get(step.shader));
    pass.draw(nothing, 3);
    return;
  }
  for (const bool mirrored : {false, true})
    drawMembers(scope, step, groups[static_cast<std::size_t>(step.group)], mirrored, programs.get(step.shader));
}

void add(shadow::LightStats& sum, const shadow::LightStats& more) {
  sum.finder = more.finder;
  sum.edgesTested += more.edgesTested;
  sum.silhouetteEdges += more.silhouetteEdges;
  sum.volumeTriangles += more.volumeTriangles;
}

Box3 boxAround(std::span<const PosedCasters> casters) {
  Box3 box;
  for (const PosedCasters& posed : casters) {
    const Box3 own = worldBounds(posed);
    if (own.empty()) continue;
    box.add(own.min);
    box.add(own.max);
  }
  return box;
}

// The sides of a part without those on which the eye lies, which only components that it touches have.
std::vector<IndexRange> seenSides(const shadow::CasterSet& casters, const VolumePart& part, const Vec3& eye,
                                  std::span<const std::uint8_t> touched) {
  std::vector<IndexRange> runs{{part.sides.first, 0}};
  for (const shadow::SilhouetteEdge& edge : part.silhouette.edges) {
    const std::size_t count = static_cast<std::size_t>(std::abs(edge.multiplicity)) * part.indicesPerSide;
    IndexRange& run = runs.back();
    if (touched[edge.component] != 0 && shadow::liesOnSide(casters, edge, part.silhouette.light, eye))
      runs.push_back({run.first + run.count + count, 0});
    else
      run.count += count;
  }
  std::erase_if(runs, [](const IndexRange& run) { return run.count == 0; });
  return runs;
}

// How one part is counted from the eye, by z-pass where it may be; `touched` gains the components that the eye touches.
Member memberOf(const PosedCasters& posed, const StoredVolume& volume, const VolumePart& part, const Vec3& eye,
                Counting counting, std::vector<std::uint8_t>& touched) {
  const shadow::CasterSet& casters = *posed.casters;
  Member m{&volume, &part, nullptr,          nullptr,  mirrors(posed), counting == Counting::zFail,
           0,       {},    &volume.vertices, part.caps};
  shadow::EyeCount atEye;
  if (counting == Counting::zFail)
    atEye.byZFail = shadow::sidesAtEye(casters, part.silhouette, eye);
  else
    atEye = counting == Counting::zMixed ? shadow::chooseAtEye(casters, part.silhouette, eye)
                                         : shadow::countAtEye(casters, part.silhouette, eye);
  m.byZFail = m.byZFail || atEye.byZFailCount > 0;
  if (!m.byZFail) m.eyeCount = atEye.count;
  if (m.byZFail)
    m.sides = seenSides(casters, part, eye, atEye.byZFail);
  else if (part.sides.count > 0)
    m.sides = {part.sides};
  for (std::size_t c = 0; c < touched.size(); ++c) touched[c] |= atEye.byZFail[c];
  return m;
}

// Only faces about the eye fill its view when they are tilted, and they lie in the casters' bounds.
bool isWithin(const Box3& box, const Vec3& eye) {
  const double slack = 0x1p-20 * box.radius();
  return glm::all(glm::greaterThanEqual(eye, box.min - slack)) && glm::all(glm::lessThanEqual(eye, box.max + slack));
}

// What the casters at place i of a call add to it.
struct Work {
  VolumeMemo& memo;
  std::vector<PlaceData>& places;
  const Box3& receivers;

  [[nodiscard]] bool endsVolumes() const { return !receivers.empty(); }

  // Where its volumes end, without the components that the eye touches.
  [[nodiscard]] Result<void> endVolumes(const PosedCasters& posed, const Vec4& light, const Vec3& eye,
                                        std::span<const std::uint8_t> touched, PlaceData& place,
                                        shadow::LightStats& stats) const {
    if (!endsVolumes()) return {};
    Box3 room = boxFrom(posed, receivers);
    room.add(eye);
    const shadow::Reach reach = shadow::reachWithin(*posed.casters, light, room, touched);
    stats.endlessCasters += reach.endlessCount();
    return place.farPoints.setAll(shadow::farPoints(*posed.casters, reach, light, eye));
  }

  [[nodiscard]] Result<std::vector<Member>> membersOf(const PosedCasters& posed, std::size_t i,
                                                      const scene::Light& light, const View& view, Counting counting,
                                                      shadow::LightStats& stats) const {
    UMBRAGE_CHECK(posed.casters != nullptr, "casters");
    const Vec4 seenFrom = lightFrom(posed, light);
    const auto positions = memo.positions(posed.casters);
    if (!positions) return tl::unexpected(positions.error());
    const auto volume = memo.volume(posed.casters, seenFrom, endsVolumes());
    if (!volume) return tl::unexpected(volume.error());
    if (auto done = places[i].view.setOne(viewBlock(viewFrom(posed, view), posed.casters->origin, seenFrom)); !done)
      return tl::unexpected(done.error());
    add(stats, (*volume)->stats);
    const Vec3 eye = pointFrom(posed, view.eye);
    std::vector<std::uint8_t> touched(posed.casters->componentCount, 0);
    std::vector<Member> members;
    for (const VolumePart& part : (*volume)->parts) {
      Member m = memberOf(posed, **volume, part, eye, counting, touched);
      m.positions = *positions;
      m.place = &places[i];
      stats.castersByZFail += counting != Counting::zFail && m.byZFail;
      stats.eyeCount += m.eyeCount;
      members.push_back(std::move(m));
    }
    for (const auto& done : {leaveOutCapsEdgeOn(*posed.casters, eye, places[i], members),
                             endVolumes(posed, seenFrom, eye, touched, places[i], stats)})
      if (!done) return tl::unexpected(done.error());
    return members;
  }

  // The memo's caps are those of any eye. One in a face's plane sees that face's cap edge-on, and single precision would tilt it into view.
  [[nodiscard]] Result<void> leaveOutCapsEdgeOn(const shadow::CasterSet& casters, const Vec3& eye, PlaceData& place,
                                                std::vector<Member>& members) const {
    const auto hasCaps = [](const Member& m) { return m.byZFail && m.caps.count > 0; };
    if (std::none_of(members.begin(), members.end(), hasCaps) || !isWithin(casters.bounds, eye) ||
        !shadow::isInAFacesPlane(casters, eye))
      return {};
    std::vector<std::uint32_t> indices;
    for (Member& m : members) {
      if (!hasCaps(m)) continue;
      const auto seen = shadow::extrude(casters, m.part->silhouette, {.endsAnywhere = endsVolumes(), .eye = eye}).caps;
      m.capVertices = &place.caps;
      m.caps = {indices.size(), seen.size()};
      indices.insert(indices.end(), seen.begin(), seen.end());
    }
    return place.capIndices.setAll(indices);
  }
};

}  // namespace

Result<StencilShadows> StencilShadows::make() {
  if (auto good = gl::checkCurrentContext(); !good) return tl::unexpected(good.error());
  StencilShadows shadows;
  shadows.quirks_ = gl::findQuirks();
  return shadows;
}

Result<StencilShadows> StencilShadows::make(shadow::CasterSet casters) {
  auto shadows = make();
  if (shadows) shadows->setCasters(std::move(casters));
  return shadows;
}

void StencilShadows::setCasters(shadow::CasterSet casters) {
  own_.casters = std::make_shared<const shadow::CasterSet>(std::move(casters));
}

Result<shadow::LightStats> StencilShadows::mark(const scene::Light& light, const HostView& view,
                                                const StencilShadowOptions& options) {
  if (own_.casters == nullptr) return mark(light, view, std::span<const PosedCasters>(), options);
  return mark(light, view, {&own_, 1}, options);
}

Result<shadow::LightStats> StencilShadows::mark(const scene::Light& light, const HostView& hostView,
                                                std::span<const PosedCasters> casters,
                                                const StencilShadowOptions& options) {
  gl::HostScope scope;
  if (scope.hostStencilBits() < 8) return fail(ErrorCode::device, "the framebuffer has fewer than 8 bits of stencil");
  if (scope.hostDepthBits() == 0) return fail(ErrorCode::device, "the framebuffer has no depth");
  const View view = viewOf(hostView.view, hostView.projection, hostView.reversed);
  gl::PassState placement = scope.hostPlacement();
  placement.frontIsClockwise = mirrors(view);
  // A ray may enter a volume through a caster that the depth buffer does not hold; without caps nobody would count that.
  const Counting counting = options.castersInDepth ? options.counting : Counting::zFail;
  UMBRAGE_CHECK(counting != Counting::zPassPlus && counting != Counting::eachTriangle,
                "Zp+ and single triangles are drawn in the house's own frames only");

  shadow::LightStats stats;
  stats.method = name(counting);
  stats.reason = options.castersInDepth ? "chosen by the host" : "the casters are not in the depth buffer";
  memo_.beginTurn();
  while (places_.size() < casters.size()) places_.emplace_back();
  std::vector<Member> members;
  for (std::size_t i = 0; i < casters.size(); ++i) {
    auto added = Work{memo_, places_, options.receivers}.membersOf(casters[i], i, light, view, counting, stats);
    if (!added) return tl::unexpected(added.error());
    members.insert(members.end(), added->begin(), added->end());
  }

  const std::vector<Group> groups = grouped(std::move(members));
  const Vec4 lamp = scene::homogeneous(light, Vec3(0.0));
  const Box3 bounds = boxAround(casters);
  Box3 counted = options.receivers;
  if (!counted.empty()) counted.add(view.eye);
  LightPlan plan{.groups = {},
                 .compareCaps = !options.castersInDepth,
                 .twoSided = quirks_.twoSidedStencil,
                 .finite = !options.receivers.empty(),
                 .volumeArea = volumeArea(view, bounds, counted, lamp, Vec3(0.0), placement),
                 .litArea = litArea(view, light, placement)};
  for (const Group& group : groups) plan.groups.push_back(group.plan());
  if (quirks_.depthBounds)
    plan.depthBounds =
        depthBounds(view, placement, volumeDistances(view, bounds, counted, lamp, Vec3(0.0)), plan.groups);
  for (const PassStep& step : planLights(placement, view.reversed, {plan}, Product::hostStencil).steps)
    runStep(scope, step, groups, programs_, nothing_);
  return stats;
}

}  // namespace umbrage::render
