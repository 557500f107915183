#include "umbrage/study/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "umbrage/base/sha256.hpp"

namespace umbrage::study {
namespace {

std::string durationText(std::chrono::milliseconds step) {
  const double minutes = double(step.count()) / 60e3;
  return minutes == std::floor(minutes) ? fmt::format("{:.0f} min", minutes) : fmt::format("{:g} s", minutes * 60.0);
}

std::string periodText(const Period& period, const PeriodSteps& steps) {
  const auto night =
      std::count_if(steps.steps.begin(), steps.steps.end(), [](const PeriodStep& s) { return !s.sunIsUp(); });
  std::string text = fmt::format("{} to {}, every {}: {} steps", sun::timeText(period.from), sun::timeText(period.to),
                                 durationText(period.step), steps.steps.size());
  if (night > 0) text += fmt::format(", {} of them with the sun below the horizon", night);
  return text;
}

std::string northText(const scene::Scene& scene) {
  const std::string axis = scene.up == scene::UpAxis::y ? "-Z, up +Y" : "+Y, up +Z";
  const double offset = scene.northOffset.degrees();
  return offset == 0.0 ? "true north is " + axis : fmt::format("true north {:g} degrees clockwise of {}", offset, axis);
}

std::string clockText(const sun::Zone& zone, const std::string& offset) {
  const std::string clock = zone.kind == sun::Zone::Kind::solar   ? "true solar time"
                            : zone.kind == sun::Zone::Kind::fixed ? "fixed"
                                                                  : zone.name;
  return clock + ", " + offset;
}

// What the pixels of a profile stand for.
std::string receiversText(const scene::Scene& scene) {
  std::string text = "the surface that the middle of each pixel shows";
  for (const scene::Instance& instance : scene.instances)
    if (instance.name == scene::kGroundName && !instance.casts)
      text += fmt::format("; ground at height {:g}",
                          glm::dot(transformPoint(instance.toWorld, scene.meshes[instance.mesh]->positions.at(0)),
                                   scene::upVector(scene.up)));
  return text;
}

std::string castersText(const std::vector<std::string>& patterns) {
  if (patterns.empty()) return "everything but the ground";
  std::string text = "only";
  for (const std::string& pattern : patterns) text += " '" + pattern + "'";
  return text;
}

}  // namespace

std::string placeText(const sun::Place& place) {
  const double latitude = place.latitude.degrees(), longitude = place.longitude.degrees();
  return fmt::format("{:.4f} {}, {:.4f} {}", std::abs(latitude), latitude < 0 ? 'S' : 'N', std::abs(longitude),
                     longitude < 0 ? 'W' : 'E');
}

LedgerLine clockLine(const sun::Zone& zone, const std::string& offset) { return {"Clock", clockText(zone, offset)}; }
LedgerLine northLine(const scene::Scene& scene) { return {"North", northText(scene)}; }
LedgerLine castersLine(const std::vector<std::string>& patterns) { return {"Casters", castersText(patterns)}; }
LedgerLine versionLine(const std::string& method, const sun::Zone& zone) {
  return {"Made by", fmt::format("Umbrage {}, {}; {}", UMBRAGE_VERSION, method, sun::versions(zone))};
}

LedgerLine sunLine(const SunModel& model, const std::string& more) {
  return {"Sun", fmt::format("{} of the disc, {}, {}", model.point == SunPoint::centre ? "centre" : "upper limb",
                             model.refraction == sun::Refraction::none ? "geometric (no refraction)"
                                                                       : "with refraction (1010 hPa, 10 degrees C)",
                             more)};
}

LedgerLine unitLine(const scene::Scene& scene) {
  const std::string unit = fmt::format("1 unit of the file = {:g} m", scene.metresPerUnit);
  return {"Unit", scene.crs.empty() ? unit + ", no reference system" : unit + ", " + scene.crs};
}

LedgerLine inputLine(const scene::Scene& scene) {
  if (scene.source.empty()) return {"Input", "made by the program"};
  const auto hash = sha256OfFile(scene.source);
  const std::string name = std::filesystem::path(scene.source).filename().string();
  return {"Input", name + (hash ? ", SHA-256 " + *hash : ", made by the program")};
}

std::vector<LedgerLine> ledgerOf(const scene::Scene& scene, const ProfileOptions& options, const PeriodSteps& steps,
                                 const shadow::Traits& technique) {
  const Period& period = options.period;
  return {{"Place", placeText(period.place)},
          {"Date", sun::dateText(period.date)},
          {"Clock", clockText(period.zone, steps.offset)},
          {"Period", periodText(period, steps)},
          sunLine({}, "declination moving (ERFA), horizon at 0 degrees"),
          northLine(scene),
          unitLine(scene),
          {"Receivers", receiversText(scene)},
          {"Casters", castersText(options.casters)},
          {"In shadow", "no direct sun: cast shadows and faces turned away; night counts as neither"},
          {"Time", "each step stands for the time of the period nearest to it"},
          inputLine(scene),
          versionLine(technique.name, period.zone)};
}

}  // namespace umbrage::study
