// A host that asks where the sun stands, and links no graphics and no ray tracer for it.
#include <umbrage/sun/sun.hpp>
#include <umbrage/sun/zone.hpp>

#include <cmath>

int main() {
  using namespace umbrage;
  using namespace std::chrono;
  const auto place = sun::makePlace(48.2, 16.37);
  if (!place) return 1;
  const auto position = sun::sunPosition(*place, sys_days(2026y / September / 18) + 11h);
  const bool right =
      std::abs(position.elevation.degrees() - 43.499) < 0.01 && std::abs(position.azimuth.degrees() - 183.900) < 0.01;
  return right ? 0 : 1;
}
