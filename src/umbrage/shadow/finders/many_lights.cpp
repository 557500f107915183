// One word holds the side of one triangle towards 64 lights. A triangle's plane is multiplied with all of them, several at a time; then
// an edge is on the silhouette of those lights in which the words of its two triangles agree (as the edge orients them): a single
// operation tells for 64. Words of 64 edges are turned, as a square of bits, into words of 64 lights, and each light takes its
// edges from its own words, in their order, so that nothing need be sorted.
#include "umbrage/shadow/finders/many_lights.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "umbrage/shadow/finders/dual_space.hpp"
#include "umbrage/shadow/finders/light_bits.hpp"
#include "umbrage/shadow/finders/threads.hpp"

namespace umbrage::shadow {
namespace {

constexpr std::size_t kEdges = 64;  // whose words are turned together
constexpr std::size_t kDense = 32;  // with more than one edge in so many on the silhouette, squares of bits are turned
constexpr std::size_t kSampled = 16;           // one block in so many is counted to know how much will be found
constexpr std::uint32_t kNegative = 1u << 31;  // in either use: the triangle is used with sign -1
constexpr std::uint32_t kHalf = 1u << 30;      // in the first: one face, named twice; in the second: of a convex solid
constexpr std::uint32_t kTriangle = kHalf - 1;

std::uint64_t flip(std::uint32_t use) { return (use & kNegative) != 0 ? ~std::uint64_t{0} : 0; }

}  // namespace

struct ManyLights::Turned {
  std::vector<EdgeBits> words;      ///< light by light
  std::vector<std::uint64_t> half;  ///< a bit an edge: its multiplicity is 1, not 2
};

// What is gathered for up to 64 lights.
struct ManyLights::Group {
  std::vector<LightBits> facing;  ///< per triangle, or per normal
  std::span<const Uses> uses;     ///< of the same
  bool byNormal;
  std::uint64_t live;
  bool halveConvex;
  Out out;
  std::array<std::vector<std::uint32_t>, kGroup> doubtful;
};

// Of 64 edges from a first one on; a word an edge, a bit a light.
struct ManyLights::Rows {
  std::array<std::uint64_t, kEdges> crossed{}, positive{}, doubtful{};
  std::uint64_t half = 0;         ///< a bit an edge: its multiplicity is 1, not 2
  std::uint64_t anyDoubtful = 0;  ///< a bit a light
  bool any = false;               ///< on a silhouette for certain
};

ManyLights::ManyLights(std::shared_ptr<const CasterSet> casters, const FinderOptions& options)
    : casters_(std::move(casters)),
      exact_(*casters_),
      threads_(threadCount(options.threads)),
      avx2_(options.vectorUnits && processorHasAvx2()) {
  const DualFrame frame = dualFrame(*casters_);
  centre_ = frame.centre, radius_ = frame.radius;
  planes_.reserve(casters_->triangles.size());
  for (std::uint32_t t = 0; t < casters_->triangles.size(); ++t)
    planes_.push_back(dualPlane(*casters_, frame, t).point);
  const auto use = [&](std::uint32_t u) {
    return casters_->uses[u].triangle | (casters_->uses[u].sign < 0 ? kNegative : 0u);
  };
  const auto outward = [&](std::uint32_t u) {
    return casters_->uses[u].sign * casters_->outward[casters_->uses[u].triangle];
  };
  uses_.reserve(casters_->edges.size());
  for (std::uint32_t e = 0; e < casters_->edges.size(); ++e) {
    const CasterEdge& edge = casters_->edges[e];
    const std::uint32_t first = edge.begin, last = edge.end - 1;
    uses_.push_back({use(first), use(last)});
    if (last > first + 1 || (last == first + 1 && outward(first) != -outward(last)))
      special_.push_back(e);
    else if (last == first)
      uses_.back()[0] |= kHalf;
    else if (outward(first) != 0)
      uses_.back()[1] |= kHalf;
  }
  shareNormals();
}

void ManyLights::shareNormals() {
  constexpr std::size_t kTried = 1024;
  const auto normal = [&](std::size_t t) {
    return std::array<float, 4>{planes_[t][0], planes_[t][1], planes_[t][2], 0.0f};
  };
  std::set<std::array<float, 4>> some;
  const std::size_t step = planes_.size() / kTried + 1;
  for (std::size_t t = 0; t < planes_.size(); t += step) some.insert(normal(t));
  if (some.size() * step * 4 > planes_.size()) return;
  std::map<std::array<float, 4>, std::uint32_t> numbers;
  normalOf_.reserve(planes_.size());
  for (std::size_t t = 0; t < planes_.size(); ++t) {
    const auto [entry, isNew] = numbers.try_emplace(normal(t), static_cast<std::uint32_t>(normals_.size()));
    if (isNew) normals_.push_back(normal(t));
    normalOf_.push_back(entry->second);
  }
  normalUses_ = uses_;
  for (Uses& uses : normalUses_)
    for (std::uint32_t& use : uses) use = (use & ~kTriangle) | normalOf_[use & kTriangle];
}

std::vector<LightBits> ManyLights::facing(std::span<const Vec4> lights, bool byNormal) const {
  LightBundle bundle{};
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const DualPoint u = dualLight({centre_, radius_}, lights[i]);
    for (int k = 0; k < 4; ++k) bundle.axis[k][i] = u[k];
  }
  std::vector<LightBits> words;
  const auto& planes = byNormal ? normals_ : planes_;
  words.reserve(planes.size());
  for (const DualPoint& plane : planes) words.push_back(lightBits(plane, bundle, avx2_));
  return words;
}

ManyLights::Rows ManyLights::rows(std::size_t firstEdge, const Group& group) const {
  Rows rows;
  const std::size_t count = std::min(kEdges, uses_.size() - firstEdge);
  auto special = std::lower_bound(special_.begin(), special_.end(), firstEdge);
  for (std::size_t i = 0; i < count; ++i) {
    if (special != special_.end() && *special == firstEdge + i) {
      ++special;
      continue;
    }
    const auto [a, b] = group.uses[firstEdge + i];
    const LightBits &first = group.facing[a & kTriangle], &second = group.facing[b & kTriangle];
    rows.doubtful[i] = (first.doubtful | second.doubtful) & group.live;
    rows.positive[i] = first.positive ^ flip(a);
    rows.crossed[i] = ~(rows.positive[i] ^ second.positive ^ flip(b)) & group.live & ~rows.doubtful[i];
    rows.half |= std::uint64_t{(a & kHalf) != 0 || (group.halveConvex && (b & kHalf) != 0)} << i;
    rows.anyDoubtful |= rows.doubtful[i];
    rows.any |= rows.crossed[i] != 0;
  }
  return rows;
}

// How many edges each light will find, from a sample.
std::vector<std::size_t> ManyLights::expected(const Group& group) const {
  std::vector<std::size_t> found(group.out.size(), 0);
  for (std::size_t e = 0; e < uses_.size(); e += kEdges * kSampled)
    for (const std::uint64_t word : rows(e, group).crossed)
      forEachBit(word, [&](std::size_t i) { found[i] += kSampled; });
  return found;
}

void ManyLights::bookDoubtful(std::size_t firstEdge, const Rows& rows, Group& group) const {
  if (rows.anyDoubtful == 0) return;
  for (std::size_t i = 0; i < kEdges; ++i)
    forEachBit(rows.doubtful[i],
               [&](std::size_t light) { group.doubtful[light].push_back(static_cast<std::uint32_t>(firstEdge + i)); });
}

void ManyLights::pickEdges(Group& group) const {
  for (std::size_t e = 0; e < uses_.size(); e += kEdges) {
    const Rows r = rows(e, group);
    bookDoubtful(e, r, group);
    if (!r.any) continue;
    for (std::size_t i = 0; i < kEdges; ++i) {
      const std::int32_t size = (r.half >> i & 1) != 0 ? 1 : 2;
      forEachBit(r.crossed[i], [&](std::size_t light) {
        group.out[light].edges.push_back(
            {static_cast<std::uint32_t>(e + i), (r.positive[i] >> light & 1) != 0 ? size : -size});
      });
    }
  }
}

ManyLights::Turned ManyLights::turn(Group& group) const {
  const std::size_t blocks = (uses_.size() + kEdges - 1) / kEdges, lights = group.out.size();
  Turned turned{std::vector<EdgeBits>(blocks * lights), std::vector<std::uint64_t>(blocks)};
  for (std::size_t b = 0; b < blocks; ++b) {
    Rows r = rows(b * kEdges, group);
    bookDoubtful(b * kEdges, r, group);
    turned.half[b] = r.half;
    if (!r.any) continue;
    transpose(r.crossed, avx2_);
    transpose(r.positive, avx2_);
    for (std::size_t light = 0; light < lights; ++light)
      turned.words[light * blocks + b] = {r.crossed[light], r.positive[light]};
  }
  return turned;
}

void ManyLights::takeTurned(const Turned& turned, std::size_t light, std::vector<SignedEdge>& edges) const {
  const std::size_t blocks = turned.half.size();
  const auto words = std::span(turned.words).subspan(light * blocks, blocks);
  edges.resize(countCrossed(words, avx2_));
  SignedEdge* next = edges.data();
  for (std::size_t b = 0; b < blocks; ++b) {
    const std::uint64_t half = turned.half[b], positive = words[b].positive;
    const auto first = static_cast<std::uint32_t>(b * kEdges);
    forEachBit(words[b].crossed, [&](std::size_t i) {
      const std::int32_t size = 2 - static_cast<std::int32_t>(half >> i & 1),
                         away = static_cast<std::int32_t>(positive >> i & 1) - 1;
      *next++ = {first + static_cast<std::uint32_t>(i), (size ^ away) - away};
    });
  }
}

// Edges of more than two faces, and folded ones of solids.
void ManyLights::addManyFaced(Group& group) const {
  for (const std::uint32_t e : special_) {
    const CasterEdge& edge = casters_->edges[e];
    const bool folded = edge.end - edge.begin == 2;
    forEachBit(group.live, [&](std::size_t i) {
      std::int32_t sum = 0;
      bool doubtful = folded;
      for (std::uint32_t u = edge.begin; u < edge.end && !doubtful; ++u) {
        const std::uint32_t triangle = casters_->uses[u].triangle;
        const LightBits& words = group.facing[group.byNormal ? normalOf_[triangle] : triangle];
        doubtful = (words.doubtful >> i & 1) != 0;
        sum += (words.positive >> i & 1) != 0 ? casters_->uses[u].sign : -casters_->uses[u].sign;
      }
      if (doubtful || sum != 0) group.doubtful[i].push_back(e);
    });
  }
}

void ManyLights::decideDoubtful(const Vec4& light, const SilhouetteOptions& options,
                                std::vector<std::uint32_t>& doubtful, std::vector<SignedEdge>& edges) const {
  if (doubtful.empty()) return;
  const auto sure = static_cast<std::ptrdiff_t>(edges.size());
  ExactEdges::Query exact(exact_, *casters_, light, options);
  std::sort(doubtful.begin(), doubtful.end());
  for (const std::uint32_t e : doubtful)
    if (const std::int32_t m = exact.multiplicity(e); m != 0) edges.push_back({e, m});
  std::inplace_merge(edges.begin(), edges.begin() + sure, edges.end(),
                     [](const SignedEdge& a, const SignedEdge& b) { return a.edge < b.edge; });
}

template <class Done>
void ManyLights::findGroup(std::span<const Vec4> lights, const SilhouetteOptions& options, Out out, bool keep,
                           const Done& done) const {
  for (FoundEdges& found : out) {
    found.edges.clear();
    found.tested = uses_.size();
    found.answeredBy = FinderKind::bruteForceSimd;
  }
  const std::uint64_t live = ~std::uint64_t{0} >> (kGroup - lights.size());
  const bool byNormal =
      !normals_.empty() && std::all_of(lights.begin(), lights.end(), [](const Vec4& l) { return l.w == 0.0; });
  Group group{
      facing(lights, byNormal), byNormal ? normalUses_ : uses_, byNormal, live, !options.countEverySurface, out, {}};
  addManyFaced(group);
  const std::vector<std::size_t> found = expected(group);
  const bool many = std::accumulate(found.begin(), found.end(), std::size_t{0}) > uses_.size() * lights.size() / kDense;
  Turned turned;
  if (many) {
    turned = turn(group);
  } else {
    for (std::size_t i = 0; i < lights.size(); ++i) out[i].edges.reserve(found[i] * 9 / 8);
    pickEdges(group);
  }
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (many) takeTurned(turned, i, out[i].edges);
    decideDoubtful(lights[i], options, group.doubtful[i], out[i].edges);
    done(i);
    // The memory is still in the cache.
    if (many && !keep && i + 1 < lights.size()) out[i + 1].edges = std::exchange(out[i].edges, {});
  }
}

// Calls work(begin, end) for groups of lights, in threads; what it returns lives through one thread.
template <class Work>
void ManyLights::inGroups(std::size_t lights, const Work& work) const {
  const std::size_t groups =
      std::max<std::size_t>((lights + kGroup - 1) / kGroup, std::min<std::size_t>(threads_, lights));
  if (groups == 0) return;
  std::atomic<std::size_t> next{0};
  const auto parts = static_cast<unsigned>(std::min<std::size_t>(groups, threads_));
  inParts(parts, 1, parts, [&](unsigned, std::size_t, std::size_t) {
    std::vector<FoundEdges> buffer(kGroup);
    for (std::size_t g = next++; g < groups; g = next++) work(lights * g / groups, lights * (g + 1) / groups, buffer);
  });
}

std::vector<FoundEdges> ManyLights::find(std::span<const Vec4> lights, const SilhouetteOptions& options) const {
  std::vector<FoundEdges> found(lights.size());
  inGroups(lights.size(), [&](std::size_t begin, std::size_t end, std::vector<FoundEdges>&) {
    findGroup(lights.subspan(begin, end - begin), options, std::span(found).subspan(begin, end - begin), true,
              [](std::size_t) {});
  });
  return found;
}

void ManyLights::visit(std::span<const Vec4> lights, const Answer& answer, const SilhouetteOptions& options) const {
  inGroups(lights.size(), [&](std::size_t begin, std::size_t end, std::vector<FoundEdges>& buffer) {
    findGroup(lights.subspan(begin, end - begin), options, std::span(buffer).first(end - begin), false,
              [&](std::size_t i) { answer(begin + i, buffer[i]); });
  });
}

std::size_t ManyLights::memory() const {
  return exact_.memory() + (normals_.capacity() + planes_.capacity()) * sizeof(planes_[0]) +
         normalOf_.capacity() * sizeof(std::uint32_t) + normalUses_.capacity() * sizeof(Uses) +
         uses_.capacity() * sizeof(uses_[0]) + special_.capacity() * sizeof(std::uint32_t);
}

}  // namespace umbrage::shadow
