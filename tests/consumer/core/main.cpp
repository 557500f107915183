// A host with triangles of its own, and no other library: how many of its surfaces hide a light from a point?
#include <umbrage/shadow/caster_set.hpp>
#include <umbrage/shadow/silhouette.hpp>
#include <umbrage/shadow/volume.hpp>

#include <vector>

int main() {
  using namespace umbrage;
  const std::vector<Vec3f> corners = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<mesh::Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  const auto casters = shadow::buildCasters(corners, square);
  const auto silhouette = shadow::findSilhouette(casters, Vec4(0, 0, 4, 1));
  const auto volume = shadow::extrude(casters, silhouette);
  const bool below = shadow::countSurfaces(casters, silhouette, Vec3(0.2, 0.1, -1)).count == 1;
  const bool above = shadow::countSurfaces(casters, silhouette, Vec3(0.2, 0.1, 1)).count == 0;
  return silhouette.edges.size() == 4 && volume.sides.size() == 3 * 2 * 4 && below && above ? 0 : 1;
}
