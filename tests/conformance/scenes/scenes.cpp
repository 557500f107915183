#include "conformance/scenes/scenes.hpp"

#include <algorithm>
#include <functional>

#include "support/shapes.hpp"
#include "umbrage/base/check.hpp"

namespace umbrage::conformance {
namespace {

using mesh::Mesh;
using scene::Scene;
using shapes::box;
using shapes::quad;

Scene grounded(std::vector<Mesh> meshes) { return scene::withGround(shapes::scene(std::move(meshes))); }

// --- closed --------------------------------------------------------------------------------------------------------------

Scene boxAlone() { return grounded({box({-1, -1, 0}, {1, 1, 2})}); }
Scene floatingSphere() { return scene::withGround(shapes::scene({shapes::sphere({0, 0, 2}, 1, 32, 20)}), 0.0); }
Scene knot() { return grounded({shapes::knot({0, 0, 2}, 1.5, 0.3, 200, 20)}); }

// Rough and self-shadowing, like a scanned animal.
Scene blob() {
  const Mesh m = shapes::grid(96, 64, true, false, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u, b = std::numbers::pi * v;
    const double ring = v == 0.0 || v == 1.0 ? 0.0 : std::sin(b);
    const double r = 1.0 + ring * (0.25 * std::sin(5 * a) * std::sin(4 * b) + 0.08 * std::sin(17 * a + 3 * b));
    return Vec3(r * ring * std::cos(a), r * ring * std::sin(a), 1.2 - r * std::cos(b));
  });
  return grounded({m});
}

Scene colonnade() {
  std::vector<Mesh> parts{box({-3, -2, 2}, {3, 2, 2.3}), box({-3, -2, 0}, {3, 2, 0.2})};
  for (int i = 0; i <= 6; ++i)
    for (const double y : {-1.7, 1.5}) parts.push_back(box({-2.9 + 0.93 * i, y, 0.2}, {-2.7 + 0.93 * i, y + 0.2, 2}));
  return grounded(parts);
}

// Light and eye may be inside the innermost, between the shells, or outside.
Scene nestedBoxes() {
  return grounded({box({-1, -1, 0}, {1, 1, 2}), box({-2, -2, -1}, {2, 2, 3}), box({-3, -3, -2}, {3, 3, 4})});
}

// --- open ----------------------------------------------------------------------------------------------------------------

Scene singleQuad() {
  return scene::withGround(shapes::scene({quad({-1, -1, 1}, {1, -1, 1}, {1, 1, 1.5}, {-1, 1, 1.5})}), 0.0);
}
Scene moebius() { return scene::withGround(shapes::scene({shapes::moebius({0, 0, 1.5}, 1.2, 0.8, 64, 4)}), 0.0); }

Scene cup() {
  const Mesh wall = shapes::grid(32, 4, true, false, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return Vec3((0.7 + 0.4 * v) * std::cos(a), (0.7 + 0.4 * v) * std::sin(a), 0.3 + 1.6 * v);
  });
  const Mesh bottom = shapes::grid(32, 1, true, false, [](double u, double v) {
    const double a = 2 * std::numbers::pi * u;
    return v == 0.0 ? Vec3(0, 0, 0.3) : Vec3(0.7 * std::cos(a), 0.7 * std::sin(a), 0.3);
  });
  return scene::withGround(shapes::scene({wall, bottom}), 0.0);
}

Scene openBox() {
  Mesh m = box({-1, -1, 0}, {1, 1, 2});
  m.triangles.resize(10);  // without the +x side
  return grounded({m});
}

// --- non-manifold --------------------------------------------------------------------------------------------------------

Scene fins() {
  const Vec3 a(0, 0, 0.2), b(0, 0, 2.2);
  std::vector<Mesh> parts;
  for (const Vec3& out : {Vec3(1.5, 0, 0), Vec3(-0.7, 1.2, 0), Vec3(-0.7, -1.2, 0.4), Vec3(0.4, 1.4, 0)})
    parts.push_back(quad(a, a + out, b + out, b));
  return scene::withGround(shapes::scene(parts), 0.0);
}

Scene cubesSharingAnEdge() {
  return grounded({box({-1, -1, 0}, {0, 0, 1}), box({0, 0, 0}, {1, 1, 1}), box({-1, 0, 1}, {0, 1, 2})});
}

// Walls that meet in a T without a common corner.
Scene tJunctions() {
  return grounded({quad({-2, 0, 0}, {2, 0, 0}, {2, 0, 2}, {-2, 0, 2}),
                   quad({0.3, 0, 0}, {0.3, 1.5, 0}, {0.3, 1.5, 1.3}, {0.3, 0, 1.3}),
                   quad({-1, 0, 0.7}, {1.5, 0, 0.7}, {1.5, -1, 0.9}, {-1, -1, 0.9})});
}

Scene duplicates() {
  const Mesh one = box({-1, -1, 0.5}, {1, 1, 1.5});
  Mesh turned = one;
  for (mesh::Triangle& t : turned.triangles) std::swap(t[1], t[2]);
  const Mesh half = quad({-2, -2, 0.2}, {0, -2, 0.2}, {0, 2, 0.2}, {-2, 2, 0.2});
  return scene::withGround(shapes::scene({one, turned, one, half, half}), 0.0);
}

// Faces that lie in each other and in one plane: stacked boxes flush on two sides, a decal, the ground touched from above.
Scene coplanarFaces() {
  return grounded({box({-1, -1, 0}, {1, 1, 1}), box({-1, -1, 1}, {0.5, 0.25, 2}), box({-0.5, -1, 0.25}, {1, 0, 1}),
                   quad({-0.75, -0.75, 1}, {0.9, -0.75, 1}, {0.9, 0.9, 1}, {-0.75, 0.9, 1})});
}

Scene slivers() {
  std::vector<Mesh> parts;
  for (int i = 0; i < 24; ++i) {
    const double x = -2 + 0.17 * i, w = 1e-5 * (i + 1) * (i + 1);
    parts.push_back(
        shapes::triangle({x, -2, 0.5 + 0.05 * i}, {x + w, 2, 1}, {x + 2 * w, -2 + 4e-5 * i, 0.5 + 0.05 * i}));
  }
  parts.push_back(box({-0.5, -0.5, 0}, {0.5, 0.5, 0.3}));
  return scene::withGround(shapes::scene(parts), 0.0);
}

// --- soups ---------------------------------------------------------------------------------------------------------------

Scene soup() {
  return scene::withGround(shapes::scene({shapes::soup(7, 120,
                                                       [](shapes::Random& r) {
                                                         return r.point({{-2, -2, 0.2}, {2, 2, 3}});
                                                       })}),
                           0.0);
}
std::function<Scene()> latticeSoup(std::uint64_t seed, int triangles, int reach) {
  return [=] {
    return scene::withGround(
        shapes::scene(
            {shapes::soup(seed, triangles, [reach](shapes::Random& r) { return r.latticePoint(-reach, reach); })}),
        double(-reach));
  };
}

// --- rooms ---------------------------------------------------------------------------------------------------------------

// Not grounded: the room's own floor is all there is. The light stands in it.
Scene room() {
  return shapes::scene({box({-3, -3, 0}, {3, 3, 3}), box({-1, 1, 0}, {0, 2, 1}), box({1, -1, 0}, {1.5, 0, 1.8}),
                        quad({-2.5, -1, 1}, {-1, -1, 1}, {-1, 0.5, 1}, {-2.5, 0.5, 1}),
                        shapes::sphere({1.5, 1.5, 1.2}, 0.4, 20, 12)});
}

Scene noCasters() {
  Scene s = boxAlone();
  for (scene::Instance& i : s.instances) i.casts = false;
  return s;
}

// --- somewhere else, and of another size ----------------------------------------------------------------------------------

std::vector<Mesh> parts() { return {box({-1, -1, 0}, {0, 1, 1.5}), shapes::knot({1.5, 0, 1.2}, 0.9, 0.2, 96, 12)}; }
Scene placed(double size, const Vec3& shift) {
  Mat4 toWorld(size);
  toWorld[3] = Vec4(size * shift, 1.0);
  return scene::withGround(shapes::scene(parts(), toWorld));
}
Scene farAway() { return placed(1.0, {85000.25, 446000.5, 12}); }
Scene justNotMoved() { return placed(1.0, {24, 13, 0}); }
Scene huge() { return placed(1e6, Vec3(0.0)); }
// As broken files have them: single precision among the scene's other coordinates must not suffer.
Mesh strayTriangle() { return shapes::triangle({4e7, 1e7, 0}, {4e7, 1.1e7, 3e6}, {4e7, 1e7, 9e6}); }
Scene tiny() { return placed(1e-3, Vec3(0.0)); }

struct Row {
  const char* name;
  std::function<Scene()> make;
  std::vector<Mesh> besides = {};  ///< comes into the scene when its lights and views are chosen
};
const std::vector<Row>& table() {
  static const std::vector<Row> rows{{"box", boxAlone},
                                     {"sphere", floatingSphere},
                                     {"knot", knot},
                                     {"blob", blob},
                                     {"colonnade", colonnade},
                                     {"nested_boxes", nestedBoxes},
                                     {"single_quad", singleQuad},
                                     {"moebius", moebius},
                                     {"cup", cup},
                                     {"open_box", openBox},
                                     {"fins", fins},
                                     {"cubes_sharing_an_edge", cubesSharingAnEdge},
                                     {"t_junctions", tJunctions},
                                     {"duplicates", duplicates},
                                     {"coplanar_faces", coplanarFaces},
                                     {"slivers", slivers},
                                     {"soup", soup},
                                     {"lattice_soup_a", latticeSoup(11, 10, 2)},
                                     {"lattice_soup_b", latticeSoup(12, 30, 3)},
                                     {"lattice_soup_c", latticeSoup(13, 60, 2)},
                                     {"room", room},
                                     {"no_casters", noCasters},
                                     {"far_away", farAway},
                                     {"just_not_moved", justNotMoved},
                                     {"huge", huge},
                                     {"tiny", tiny},
                                     {"stray_triangle", justNotMoved, {strayTriangle()}}};
  return rows;
}

}  // namespace

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const Row& row : table()) names.push_back(row.name);
  return names;
}

Case makeCase(const std::string& name) {
  const auto row = std::find_if(table().begin(), table().end(), [&](const Row& r) { return name == r.name; });
  UMBRAGE_CHECK(row != table().end(), "no such scene");
  Case c{name, row->make(), {}, {}};
  c.lights = standardLights(c.scene);
  c.views = standardViews(c.scene, c.lights);
  for (const Mesh& m : row->besides) {
    c.scene.instances.push_back({m.name, static_cast<std::uint32_t>(c.scene.meshes.size())});
    c.scene.meshes.push_back(std::make_shared<Mesh>(m));
  }
  return c;
}

}  // namespace umbrage::conformance
