// When does the sun reach a window? Exact hours of one point in the courtyard that comes with the library, on 18 September 2026 in Vienna.
#include <umbrage/samples/samples.hpp>
#include <umbrage/study/exact_hours.hpp>
#include <umbrage/sun/zone.hpp>

#include <cstdio>

int main() {
  using namespace umbrage;
  using namespace std::chrono_literals;
  const auto scene = samples::make("courtyard");
  const auto zone = sun::parseZone("+02:00");
  const sun::Place vienna{Angle::degrees(48.2), Angle::degrees(16.37)};
  if (!scene || !zone) return 1;

  // Built once for a scene at a place; any number of days and points may be asked.
  const auto hours = study::ExactHours::build(*scene, vienna);
  if (!hours) return std::fprintf(stderr, "%s\n", hours.error().text().c_str()), 1;
  const sun::Instant midnight = std::chrono::sys_days(2026y / std::chrono::September / 18) - 2h;
  const auto day = study::SunCourse::make(vienna, {midnight, midnight + 24h});

  const study::Receiver points[] = {{{5, 14.5, 2}, {0, -1, 0}}, {{5, 5, 1.5}, {0, 0, 1}}};
  const auto lit = hours->at(points, day);
  if (!lit) return std::fprintf(stderr, "%s\n", lit.error().text().c_str()), 1;
  for (std::size_t i = 0; i < lit->size(); ++i) {
    std::printf("point %zu: %.3f h\n", i, double(lit->total(i).count()) / 3.6e6);
    for (const study::TimeSpan& s : lit->lit(i))
      std::printf("  %s to %s\n", sun::timeText(sun::clockAt(*zone, vienna, s.from).clock.time).c_str(),
                  sun::timeText(sun::clockAt(*zone, vienna, s.to).clock.time).c_str());
  }
}
