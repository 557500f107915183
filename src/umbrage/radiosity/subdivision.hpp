#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "umbrage/scene/surfaces.hpp"

namespace umbrage::radiosity {

/// None of vertices, elements and the like.
inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Triangles of one plane and material that hang together: light is continuous over them but for shadows.
struct Sheet {
  Vec3 normal{0.0};  ///< unit; side 0 is the one it points to, side 1 the other
  std::uint32_t material = 0;
};

/// Where light is known.
struct Vertex {
  Vec3 position;  ///< relative to the origin of the surfaces
  Vec3 sample;  ///< where it is looked at: a little inside the sheet, so that nothing is met that stands at its border
  std::uint32_t sheet = 0;
  std::uint32_t triangle = 0;  ///< of the surfaces; one of those that hold `sample`
};

/// A triangle of a surface, or one that it was cut into.
struct Element {
  std::array<std::uint32_t, 3> corner{};  ///< vertices
  std::uint32_t centre = 0;               ///< the vertex in its middle
  std::uint32_t triangle = 0;             ///< of the surfaces
  std::uint32_t children = 0;  ///< the first of four: at corner 0, 1 and 2, and the middle one; 0: it has none
};

/// Where a point of a triangle lies.
struct Place {
  std::uint32_t element;  ///< a leaf
  Vec3 parts;             ///< between its corners; adds up to 1
};

/// Part of what is at a place.
struct Share {
  std::uint32_t vertex;
  double part;
};

/// The triangles of surfaces, cut into four again and again, each as often as somebody wants.
/// 1. Vertices are shared by all elements of one sheet; children have the same centres as they would have without their parent.
/// 2. Triangles without area, and all but the first of those that coincide, have no elements of their own.
class Subdivision {
 public:
  /// REQUIRES: outlived by it.
  explicit Subdivision(const scene::Surfaces& surfaces);

  [[nodiscard]] const scene::Surfaces& surfaces() const { return *surfaces_; }
  [[nodiscard]] const std::vector<Sheet>& sheets() const { return sheets_; }
  [[nodiscard]] const std::vector<Vertex>& vertices() const { return vertices_; }
  [[nodiscard]] const std::vector<Element>& elements() const { return elements_; }
  /// The element that is all of a triangle; kNone where it has none.
  [[nodiscard]] std::uint32_t root(std::uint32_t triangle) const { return roots_[triangle]; }
  [[nodiscard]] const Sheet& sheetOf(const Element& element) const { return sheets_[vertices_[element.centre].sheet]; }
  [[nodiscard]] std::array<Vec3, 3> corners(const Element& element) const;
  [[nodiscard]] double area(const Element& element) const;
  [[nodiscard]] double longestEdge(const Element& element) const;

  /// Cuts a leaf in four. Vertices that this makes are at the end of vertices().
  void split(std::uint32_t element);
  /// Cuts whatever is wanted of `element` and of what becomes of it.
  void splitWhile(std::uint32_t element, const std::function<bool(const Element&)>& wanted);
  /// Sets Vertex::sample of those from `first` on by the leaves around them, at least so far inside as rounding asks (`apart`, by coordinate).
  void placeSamples(std::size_t first, const std::function<double(const Vertex&)>& apart);

  /// Calls fn(element index) for every leaf of an element.
  template <class Fn>
  void forEachLeaf(std::uint32_t element, const Fn& fn) const {
    if (const std::uint32_t children = elements_[element].children; children != 0)
      for (std::uint32_t k = 0; k < 4; ++k) forEachLeaf(children + k, fn);
    else
      fn(element);
  }

  /// The leaf that holds a point, given by its parts of the triangle's corners.
  [[nodiscard]] std::optional<Place> find(std::uint32_t triangle, Vec3 parts) const;

  /// Which vertices a place is between, and how much of each it has; adds up to 1. Continuous over the whole sheet.
  [[nodiscard]] std::array<Share, 3> between(const Place& place) const;

  /// The corners of a leaf in order, with those that neighbours have set upon its edges.
  void outline(std::uint32_t leaf, std::vector<std::uint32_t>& out) const;

 private:
  void makeSheets();
  void makeRoots();
  std::uint32_t addVertex(const Vec3& position, std::uint32_t sheet, std::uint32_t triangle);
  std::uint32_t addElement(const std::array<std::uint32_t, 3>& corner, std::uint32_t triangle);
  std::uint32_t middleOf(std::uint32_t a, std::uint32_t b, std::uint32_t triangle);
  void addChain(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& out) const;

  const scene::Surfaces* surfaces_;
  std::vector<Sheet> sheets_;
  std::vector<std::uint32_t> sheetOfTriangle_;
  std::vector<Vertex> vertices_;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> roots_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< by the two ends of an edge
};

/// A piece of a subdivided surface that needs no neighbours to be drawn without gaps.
struct Face {
  std::array<std::uint32_t, 3> corner;  ///< vertices, in the sense of the sheet's normal
};

/// All leaves as faces around their centres: what neighbours have set upon their edges are corners of theirs too, so nothing gapes.
[[nodiscard]] std::vector<Face> faces(const Subdivision& mesh);

}  // namespace umbrage::radiosity
