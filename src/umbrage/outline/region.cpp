#include "umbrage/outline/region.hpp"

namespace umbrage::outline {

double areaOf(const Ring& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // Relative to the first corner, so that far coordinates do not cancel.
    const Vec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return 0.5 * sum;
}

double areaOf(const Polygon& polygon) {
  double area = areaOf(polygon.outer);
  for (const Ring& hole : polygon.holes) area += areaOf(hole);
  return area;
}

}  // namespace umbrage::outline
