#pragma once

#include "options.hpp"
#include "place.hpp"
#include "umbrage/outline/casters.hpp"
#include "umbrage/report/vector_map.hpp"

// What the commands that draw maps share.
namespace umbrage::cli {

struct MapOptions {
  std::optional<double> plane;  ///< height, in the scene's unit; nothing: its lowest point
  std::string output;
};
/// --plane and -o.
void addMapOptions(CLI::App& app, MapOptions& options);

/// Refuses an output that cannot be written, or of another kind than a map.
[[nodiscard]] Result<void> checkMapFile(const MapOptions& options, const std::string& scene);

/// The height of the plane.
[[nodiscard]] double planeOf(const MapOptions& options, const scene::Scene& scene);

/// A map of the scene with its buildings and the ledger that all maps have; layers and features are the caller's. `sun` says what is added to how the
/// sun was taken (study::sunLine), `method` how the map was made.
struct MapSubject {
  std::string title, sun, method;
  std::vector<study::LedgerLine> more;
};
[[nodiscard]] Result<report::VectorMap> mapOf(const scene::Scene& scene,
                                              const std::vector<outline::CasterPart>& casters, double plane,
                                              const sun::Place& place, const PlaceOptions& when,
                                              const std::string& clockOffset, const MapSubject& subject,
                                              const std::vector<std::string>& patterns);

/// Writes it with signals waiting.
[[nodiscard]] Result<void> write(const report::VectorMap& map, const MapOptions& options);

}  // namespace umbrage::cli
