#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "umbrage/outline/region.hpp"
#include "umbrage/rules/rule.hpp"
#include "umbrage/scene/scene.hpp"
#include "umbrage/study/receivers.hpp"

namespace umbrage::rules {

/// An open space, or a site: in the plan of a scene (study::mapPoint), in its unit.
struct Area {
  std::string name;
  outline::Region region;
};

/// The polygons of a GeoJSON file as areas of a scene, one for each feature, named by its "name" or "id". Coordinates are longitude and latitude
/// (RFC 7946) or what a "crs" names, and are projected to the scene's reference system; `"crs": null` means the scene's own.
/// Errors: input, where the file has no polygon, is broken, or is in degrees and the scene has no reference system.
[[nodiscard]] Result<std::vector<Area>> readAreas(const std::filesystem::path& path, const scene::Scene& scene);

/// One point that a rule looks at.
struct Target {
  study::Receiver receiver;
  double weight = 1.0;    ///< square metres that it stands for; 1 for points
  std::size_t group = 0;  ///< of TargetSet::groups
  double fromSite = 0.0;  ///< metres
};

struct TargetSet {
  std::vector<Target> targets;
  std::vector<std::string> groups;  ///< what is judged by itself: the open spaces; one for points
  double step = 0.0;                ///< of grids, in the scene's unit; 0: points
  std::string described;            ///< for the ledger
  /// Whose cells these are, one a group, and the height of their plane in the scene's unit; empty for points and around sites. Where no new shadow
  /// at all may lie on them their outlines are asked too.
  std::vector<Area> areas;
  double height = 0.0;
};

/// More receivers than these, some 250 bytes each with what is found at them, are refused before any memory is used.
inline constexpr std::size_t kMostTargets = 10'000'000;

/// All points together are one group.
[[nodiscard]] TargetSet pointTargets(const study::ReceiverSet& set);

/// The middles of a grid's cells within each area, facing up, each standing for the same part of its area. An area that holds no middle
/// of a cell gets one point within it. REQUIRES: step > 0. Errors: usage (no area, or more points than kMostTargets).
[[nodiscard]] Result<TargetSet> areaTargets(const std::vector<Area>& areas, const scene::Scene& scene, double step,
                                            double height);

struct SiteGrid {
  double height = 0.0;  ///< of the plane, in the scene's unit
  double along = 0.25;  ///< metres from point to point on the lines
  double step = 1.0;    ///< metres of the grid beyond the nearest line
  double reach = 0.0;   ///< metres from the site within which points are wanted
};
/// Points on the lines around a site at which the rule's bands begin, and on a grid beyond the nearest of them; of a band without a beginning, and of
/// a requirement without a band, from the site's border on. Of a shorter reach they are some of those of a longer one.
/// REQUIRES: along > 0, step > 0. Errors: usage (the site is empty, the rule looks at no site, more points than kMostTargets).
[[nodiscard]] Result<TargetSet> siteTargets(const Area& site, const Rule& rule, const scene::Scene& scene,
                                            const SiteGrid& grid);

/// How far, in metres, parts that cast and whose middle lies on the site may reach beyond it: by their boxes.
[[nodiscard]] double overhang(const scene::Scene& scene, const Area& site);

/// The parts whose middle in plan lies on the site cast, and no others. Errors: usage, where none does.
[[nodiscard]] Result<scene::Scene> castersOnSite(scene::Scene scene, const Area& site);

}  // namespace umbrage::rules
