#include "umbrage/radiosity/subdivision.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "umbrage/base/check.hpp"

namespace umbrage::radiosity {
namespace {

/// Samples lie this part of the way from their vertex to the middle of an element.
constexpr double kInside = 0x1p-10;
/// Cosine of what rounding may turn neighbours in one plane by.
constexpr double kSamePlane = 1.0 - 5e-9;

std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Sets that grow together.
class Union {
 public:
  explicit Union(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

struct EdgeOf {
  std::uint64_t edge;
  std::uint32_t triangle;
  friend auto operator<=>(const EdgeOf&, const EdgeOf&) = default;
};

std::vector<EdgeOf> edgesOf(const scene::Surfaces& surfaces) {
  std::vector<EdgeOf> edges;
  edges.reserve(3 * surfaces.triangles.size());
  std::set<mesh::Triangle> known;
  for (std::uint32_t t = 0; t < surfaces.triangles.size(); ++t) {
    if (!known.insert(surfaces.triangles[t]).second) continue;
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back({pairKey(surfaces.triangles[t][k], surfaces.triangles[t][(k + 1) % 3]), t});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

}  // namespace

Subdivision::Subdivision(const scene::Surfaces& surfaces) : surfaces_(&surfaces) {
  makeSheets();
  makeRoots();
}

void Subdivision::makeSheets() {
  const std::size_t count = surfaces_->triangles.size();
  std::vector<Vec3> normals(count, Vec3(0.0));
  for (std::uint32_t t = 0; t < count; ++t)
    if (const Vec3 n = surfaces_->normal(t); glm::length(n) > 0.0) normals[t] = glm::normalize(n);
  const auto alike = [&](std::uint32_t a, std::uint32_t b) {
    return surfaces_->materials[a] == surfaces_->materials[b] && surfaces_->casts[a] == surfaces_->casts[b] &&
           std::abs(glm::dot(normals[a], normals[b])) > kSamePlane;
  };
  Union sets(count);
  const auto edges = edgesOf(*surfaces_);
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].edge == edges[begin].edge) ++end;
    // Where more than two meet, something stands upon the others, and light ends there.
    if (end - begin == 2 && alike(edges[begin].triangle, edges[begin + 1].triangle))
      sets.join(edges[begin].triangle, edges[begin + 1].triangle);
  }
  sheetOfTriangle_.assign(count, kNone);
  for (std::uint32_t t = 0; t < count; ++t) {
    const std::uint32_t first = sets.find(t);
    if (first == t) {
      sheetOfTriangle_[t] = static_cast<std::uint32_t>(sheets_.size());
      sheets_.push_back({normals[t], surfaces_->materials[t]});
    } else {
      sheetOfTriangle_[t] = sheetOfTriangle_[first];
    }
  }
}

void Subdivision::makeRoots() {
  roots_.assign(surfaces_->triangles.size(), kNone);
  std::map<mesh::Triangle, std::uint32_t> known;
  std::unordered_map<std::uint64_t, std::uint32_t> corners;
  for (std::uint32_t t = 0; t < roots_.size(); ++t) {
    const std::uint32_t sheet = sheetOfTriangle_[t];
    const Vec3 normal = surfaces_->normal(t);
    if (!(glm::length(normal) > 0.0)) continue;
    const auto [same, isNew] = known.try_emplace(surfaces_->triangles[t], t);
    if (!isNew) {
      roots_[t] = roots_[same->second];
      continue;
    }
    std::array<std::uint32_t, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t position = surfaces_->triangles[t][k];
      const auto [at, first] = corners.try_emplace(std::uint64_t{sheet} << 32 | position, kNone);
      if (first) at->second = addVertex(surfaces_->corner(t, int(k)), sheet, t);
      corner[k] = at->second;
    }
    roots_[t] = addElement(corner, t);
  }
}

std::uint32_t Subdivision::addVertex(const Vec3& position, std::uint32_t sheet, std::uint32_t triangle) {
  vertices_.push_back({position, position, sheet, triangle});
  return static_cast<std::uint32_t>(vertices_.size()) - 1;
}

std::uint32_t Subdivision::addElement(const std::array<std::uint32_t, 3>& corner, std::uint32_t triangle) {
  Element element{corner, 0, triangle, 0};
  const auto at = corners(element);
  element.centre = addVertex((at[0] + at[1] + at[2]) / 3.0, sheetOfTriangle_[triangle], triangle);
  elements_.push_back(element);
  return static_cast<std::uint32_t>(elements_.size()) - 1;
}

std::uint32_t Subdivision::middleOf(std::uint32_t a, std::uint32_t b, std::uint32_t triangle) {
  const auto [at, isNew] = middles_.try_emplace(pairKey(a, b), kNone);
  if (isNew)
    at->second = addVertex(0.5 * (vertices_[a].position + vertices_[b].position), vertices_[a].sheet, triangle);
  return at->second;
}

std::array<Vec3, 3> Subdivision::corners(const Element& element) const {
  return {vertices_[element.corner[0]].position, vertices_[element.corner[1]].position,
          vertices_[element.corner[2]].position};
}

double Subdivision::area(const Element& element) const {
  const auto [a, b, c] = corners(element);
  return 0.5 * glm::length(glm::cross(b - a, c - a));
}

double Subdivision::longestEdge(const Element& element) const {
  const auto [a, b, c] = corners(element);
  return std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
}

void Subdivision::split(std::uint32_t index) {
  const Element parent = elements_[index];
  UMBRAGE_CHECK(parent.children == 0, "a leaf");
  std::array<std::uint32_t, 3> opposite{};  // the middles of the edges, by the corner across
  for (std::size_t k = 0; k < 3; ++k)
    opposite[k] = middleOf(parent.corner[(k + 1) % 3], parent.corner[(k + 2) % 3], parent.triangle);
  const auto first = static_cast<std::uint32_t>(elements_.size());
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<std::uint32_t, 3> corner = opposite;
    corner[k] = parent.corner[k];
    // The middles stand where the corners stood that they are halfway to.
    std::swap(corner[(k + 1) % 3], corner[(k + 2) % 3]);
    addElement(corner, parent.triangle);
  }
  elements_.push_back({opposite, parent.centre, parent.triangle, 0});
  elements_[index].children = first;
}

void Subdivision::splitWhile(std::uint32_t element, const std::function<bool(const Element&)>& wanted) {
  if (!wanted(elements_[element])) return;
  if (elements_[element].children == 0) split(element);
  const std::uint32_t children = elements_[element].children;
  for (std::uint32_t k = 0; k < 4; ++k) splitWhile(children + k, wanted);
}

void Subdivision::placeSamples(std::size_t first, const std::function<double(const Vertex&)>& apart) {
  std::vector<bool> placed(vertices_.size() - first, false);
  for (const Element& element : elements_) {
    if (element.children != 0) continue;
    const Vec3 centre = vertices_[element.centre].position;
    for (const std::uint32_t v : element.corner) {
      if (v < first || placed[v - first]) continue;
      placed[v - first] = true;
      Vertex& vertex = vertices_[v];
      const Vec3 inwards = centre - vertex.position;
      const double least = std::min(0.5, apart(vertex) / std::max(glm::length(inwards), 1e-300));
      vertex.sample = vertex.position + std::max(kInside, least) * inwards;
      vertex.triangle = element.triangle;
    }
  }
}

std::optional<Place> Subdivision::find(std::uint32_t triangle, Vec3 parts) const {
  std::uint32_t element = roots_[triangle];
  if (element == kNone) return std::nullopt;
  while (const std::uint32_t children = elements_[element].children) {
    int corner = 0;
    while (corner < 3 && parts[corner] < 0.5) ++corner;
    if (corner < 3) {
      parts = 2.0 * parts;
      parts[corner] -= 1.0;
    } else {
      parts = 1.0 - 2.0 * parts;
    }
    element = children + static_cast<std::uint32_t>(corner);
  }
  return Place{element, parts};
}

// The place lies in the sector between the middle and the edge across from the corner it has least of; there on a straight line from the middle to a
// point of that edge, which lies between two neighbours of those set upon it.
std::array<Share, 3> Subdivision::between(const Place& place) const {
  const Element& element = elements_[place.element];
  const Vec3 parts = glm::max(place.parts, Vec3(0.0));
  const int least = parts.x <= parts.y ? (parts.x <= parts.z ? 0 : 2) : (parts.y <= parts.z ? 1 : 2);
  const int k = (least + 1) % 3, l = (least + 2) % 3;
  std::uint32_t a = element.corner[static_cast<std::size_t>(k)], b = element.corner[static_cast<std::size_t>(l)];
  const double ofMiddle = 3.0 * parts[least], ofEdge = parts[k] + parts[l] - 2.0 * parts[least];
  double along = ofEdge > 0.0 ? (parts[l] - parts[least]) / ofEdge : 0.0;
  for (auto middle = middles_.find(pairKey(a, b)); middle != middles_.end(); middle = middles_.find(pairKey(a, b))) {
    (along < 0.5 ? b : a) = middle->second;
    along = along < 0.5 ? 2.0 * along : 2.0 * along - 1.0;
  }
  return {Share{element.centre, ofMiddle}, Share{a, ofEdge * (1.0 - along)}, Share{b, ofEdge * along}};
}

void Subdivision::addChain(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& out) const {
  const auto middle = middles_.find(pairKey(a, b));
  if (middle == middles_.end()) return out.push_back(a);
  addChain(a, middle->second, out);
  addChain(middle->second, b, out);
}

void Subdivision::outline(std::uint32_t leaf, std::vector<std::uint32_t>& out) const {
  out.clear();
  const auto& corner = elements_[leaf].corner;
  for (std::size_t k = 0; k < 3; ++k) addChain(corner[k], corner[(k + 1) % 3], out);
}

std::vector<Face> faces(const Subdivision& mesh) {
  std::vector<Face> out;
  std::vector<std::uint32_t> outline;
  for (std::uint32_t e = 0; e < mesh.elements().size(); ++e) {
    const Element& element = mesh.elements()[e];
    if (element.children != 0) continue;
    mesh.outline(e, outline);
    const auto [a, b, c] = mesh.corners(element);
    const bool turned = glm::dot(glm::cross(b - a, c - a), mesh.sheetOf(element).normal) < 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const std::uint32_t from = outline[i], to = outline[i + 1 < outline.size() ? i + 1 : 0];
      out.push_back({turned ? std::array{to, from, element.centre} : std::array{from, to, element.centre}});
    }
  }
  return out;
}

}  // namespace umbrage::radiosity
