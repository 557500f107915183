#include "umbrage/render/gpu_finder.hpp"

#include <algorithm>
#include <cstddef>
#include <umbrage_shaders/silhouette_caps_comp.hpp>
#include <umbrage_shaders/silhouette_edges_comp.hpp>
#include <umbrage_shaders/silhouette_sides_comp.hpp>

#include "umbrage/base/check.hpp"
#include "umbrage/gl/compute.hpp"
#include "umbrage/gl/quirks.hpp"
#include "umbrage/render/gpu_scene.hpp"
#include "umbrage/shadow/layering.hpp"

namespace umbrage::render {
namespace {

constexpr unsigned kGroup = 64;  // local_size_x of the shaders
constexpr std::uint32_t kNegative = 1u << 31;
constexpr std::uint32_t kMostComponents = 1u << 30;  // two bits beside them say which side is outward
constexpr std::size_t kIndicesPerListed = 2;

struct Row {
  std::uint32_t a, b, c, d;
};

// As the shaders' block Query, in std140.
struct Query {
  Vec4 light, eye;
  std::array<std::uint32_t, 4> counts, format;
};
static_assert(sizeof(Query) == 96);

// As the shaders' block Draws.
struct Draws {
  std::array<gl::IndirectDraw, 3> draw;
  std::uint32_t found = 0;
};
static_assert(sizeof(Draws) == 64);

std::vector<Row> triangleRows(const shadow::CasterSet& casters) {
  std::vector<Row> rows;
  rows.reserve(casters.triangles.size());
  for (std::size_t t = 0; t < casters.triangles.size(); ++t) {
    const auto [a, b, c] = casters.triangles[t];
    const auto outward = static_cast<std::uint32_t>(casters.outward[t] + 1) << 30;
    rows.push_back({a, b, c, casters.componentOf[t] | outward});
  }
  return rows;
}

struct EdgeRows {
  std::vector<Row> edges;
  std::vector<std::uint32_t> uses;
};

EdgeRows edgeRows(const shadow::CasterSet& casters) {
  EdgeRows rows;
  rows.edges.reserve(casters.edges.size() + 1);
  rows.uses.reserve(casters.uses.size());
  for (const shadow::CasterEdge& edge : casters.edges) {
    const auto first = static_cast<std::uint32_t>(rows.uses.size());
    rows.edges.push_back({edge.a, edge.b, first, casters.componentOf[casters.uses[edge.begin].triangle]});
    for (std::uint32_t u = edge.begin; u < edge.end; ++u)
      rows.uses.push_back(casters.uses[u].triangle | (casters.uses[u].sign < 0 ? kNegative : 0));
  }
  rows.edges.push_back({0, 0, static_cast<std::uint32_t>(rows.uses.size()), 0});
  return rows;
}

std::size_t indicesPerCap(const CardRequest& request) { return request.farCaps ? 6 : 3; }

}  // namespace

CardCounts countsOf(const CardVolume& volume) {
  Draws draws;
  volume.draws.read(std::as_writable_bytes(std::span(&draws, 1)));
  CardCounts counts;
  counts.edges = draws.found;
  for (std::size_t i = 0; i < draws.draw.size(); ++i) counts.indices[i] = draws.draw[i].count;
  const std::size_t sides = (counts.indices[CardVolume::passSides] + counts.indices[CardVolume::failSides]) /
                            static_cast<std::size_t>(volume.sides);
  counts.triangles = sides * (volume.farCaps ? 2 : 1) + counts.indices[CardVolume::failCaps] / 3;
  return counts;
}

FinderPrograms::FinderPrograms()
    : sides(gl::Program::compute(shaders::kSilhouetteSidesComp)),
      caps(gl::Program::compute(shaders::kSilhouetteCapsComp)),
      edges(gl::Program::compute(shaders::kSilhouetteEdgesComp)) {}

GpuFinder::GpuFinder(std::shared_ptr<const shadow::CasterSet> casters, std::shared_ptr<const FinderPrograms> programs)
    : SilhouetteFinder(shadow::FinderKind::gpu, std::move(casters)), programs_(std::move(programs)) {
  if (programs_ == nullptr) programs_ = std::make_shared<const FinderPrograms>();
}

Result<std::unique_ptr<GpuFinder>> GpuFinder::make(std::shared_ptr<const shadow::CasterSet> casters,
                                                   std::shared_ptr<const FinderPrograms> programs) {
  UMBRAGE_CHECK(casters != nullptr, "casters");
  if (casters->componentCount >= kMostComponents || casters->triangles.size() >= kNegative)
    return fail(ErrorCode::device, "more casters than the graphics card can number");
  std::unique_ptr<GpuFinder> finder(new GpuFinder(std::move(casters), std::move(programs)));
  if (auto done = finder->upload(); !done) return tl::unexpected(done.error());
  return finder;
}

Result<void> GpuFinder::upload() {
  const shadow::CasterSet& set = casters();
  const std::vector<Row> triangles = triangleRows(set);
  const EdgeRows edges = edgeRows(set);
  usesOf_.assign(set.componentCount, 0);
  trianglesOf_.assign(set.componentCount, 0);
  for (const shadow::CasterEdge& edge : set.edges)
    usesOf_[set.componentOf[set.uses[edge.begin].triangle]] += edge.end - edge.begin;
  for (const std::uint32_t component : set.componentOf) ++trianglesOf_[component];
  for (const auto& done : {setStorage(positions_, std::as_bytes(std::span(set.positions)), "positions"),
                           setStorage(triangles_, std::as_bytes(std::span(triangles)), "triangles"),
                           setStorage(edges_, std::as_bytes(std::span(edges.edges)), "edges"),
                           setStorage(uses_, std::as_bytes(std::span(edges.uses)), "edges")})
    if (!done) return done;
  memory_ = positions_.bytes() + triangles_.bytes() + edges_.bytes() + uses_.bytes();
  return side_.reserve(4 * set.triangles.size());
}

std::size_t GpuFinder::memory() const {
  return memory_ + side_.bytes() + (usesOf_.capacity() + trianglesOf_.capacity()) * sizeof(std::size_t);
}

// An edge is drawn at most once for each triangle that uses it.
std::array<std::size_t, 3> GpuFinder::capacities(const CardRequest& request) const {
  std::array<std::size_t, 3> most{};
  for (std::size_t c = 0; c < request.roles.size(); ++c) {
    if (request.roles[c] == Role::leftOut) continue;
    const bool fails = request.roles[c] != Role::pass;
    most[fails ? CardVolume::failSides : CardVolume::passSides] += usesOf_[c] * static_cast<std::size_t>(request.sides);
    if (fails) most[CardVolume::failCaps] += trianglesOf_[c] * indicesPerCap(request);
  }
  return most;
}

bool GpuFinder::fits(const CardRequest& request) const {
  const auto most = capacities(request);
  return (most[0] + most[1] + most[2]) * sizeof(std::uint32_t) <= gl::findQuirks().maxStorageBytes;
}

int GpuFinder::layers(const Vec4& light) const {
  if (layers_ >= 0 && light == layersFor_) return layers_;
  shadow::Silhouette every;
  every.light = light;
  every.side = shadow::findSides(casters(), light);
  layers_ = shadow::layeringBound(casters(), every);
  layersFor_ = light;
  return layers_;
}

Result<void> GpuFinder::extrude(gl::HostScope& scope, const CardRequest& request, CardVolume& out) const {
  return run(scope, request, false, out);
}

Result<void> GpuFinder::run(gl::HostScope& scope, const CardRequest& request, bool listsEdges, CardVolume& out) const {
  const shadow::CasterSet& set = casters();
  UMBRAGE_CHECK(request.roles.size() == set.componentCount, "one role a component");
  auto most = capacities(request);
  if (listsEdges) most = {kIndicesPerListed * set.edges.size(), 0, 0};
  Draws draws;
  for (std::uint32_t i = 0, first = 0; i < 3; first += static_cast<std::uint32_t>(most[i++]))
    draws.draw[i].firstIndex = first;
  const auto side = listsEdges ? kIndicesPerListed : static_cast<std::size_t>(request.sides);
  const Query query{
      .light = request.light,
      .eye = Vec4(request.eye, 1.0),
      .counts = {static_cast<std::uint32_t>(set.triangles.size()), static_cast<std::uint32_t>(set.edges.size()),
                 request.options.countEverySurface ? 1u : 0u, 0},
      .format = {static_cast<std::uint32_t>(side), static_cast<std::uint32_t>(indicesPerCap(request)),
                 listsEdges ? 1u : 0u, 0}};
  for (const auto& done : {query_.setOne(query), out.draws.setOne(draws), roles_.set(std::as_bytes(request.roles)),
                           seen_.setAll(std::vector<std::uint32_t>(set.componentCount, 0)),
                           out.indices.reserve((most[0] + most[1] + most[2]) * sizeof(std::uint32_t))})
    if (!done) return done;

  out.sides = request.sides;
  out.farCaps = request.farCaps;
  gl::Compute compute(scope);
  compute.uniforms(0, query_);
  compute.storage(0, positions_);
  compute.storage(1, triangles_);
  compute.storage(2, side_);
  compute.storage(3, seen_);
  compute.storage(4, roles_);
  compute.storage(5, out.indices);
  compute.storage(6, out.draws);
  compute.use(programs_->sides);
  compute.dispatch(set.triangles.size(), kGroup);
  compute.use(programs_->caps);
  compute.dispatch(set.triangles.size(), kGroup);
  compute.storage(1, edges_);
  compute.storage(3, uses_);
  compute.use(programs_->edges);
  compute.dispatch(set.edges.size(), kGroup);
  return {};
}

shadow::FoundEdges GpuFinder::readEdges(const CardVolume& volume) const {
  const std::size_t words = countsOf(volume).indices[CardVolume::passSides];
  const auto list = volume.indices.readAll<std::uint32_t>(words);
  shadow::FoundEdges found{{}, casters().edges.size(), kind()};
  found.edges.reserve(words / kIndicesPerListed);
  for (std::size_t i = 0; i < words; i += kIndicesPerListed)
    found.edges.push_back({list[i], static_cast<std::int32_t>(list[i + 1])});
  std::sort(found.edges.begin(), found.edges.end(),
            [](const shadow::SignedEdge& a, const shadow::SignedEdge& b) { return a.edge < b.edge; });
  return found;
}

shadow::FoundEdges GpuFinder::find(const Vec4& light, const shadow::SilhouetteOptions& options) const {
  const std::vector<Role> all(casters().componentCount, Role::pass);
  gl::HostScope scope;
  const CardRequest request{.light = light, .roles = all, .options = options};
  // An answer that cannot be had for want of memory is asked of the processor.
  if (!run(scope, request, true, found_))
    return shadow::makeFinder(shadow::FinderKind::bruteForceSimd, share())->find(light, options);
  return readEdges(found_);
}

shadow::Silhouette GpuFinder::silhouette(const Vec4& light, const shadow::SilhouetteOptions& options) const {
  const shadow::FoundEdges found = find(light, options);
  if (found.answeredBy != kind()) return assemble(casters(), light, found, findSides(casters(), light, options));
  const auto words = side_.readAll<std::int32_t>(casters().triangles.size());
  return assemble(casters(), light, found, std::vector<std::int8_t>(words.begin(), words.end()));
}

}  // namespace umbrage::render
