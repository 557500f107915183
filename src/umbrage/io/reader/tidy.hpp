#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "umbrage/scene/scene.hpp"

namespace umbrage::io::reader {

/// A coordinate beyond this counts as not finite: its square would not fit into single precision.
inline constexpr double kMaxCoordinate = 1e15;

/// The scene made lawful (scene::findFault finds nothing) and compact:
/// 1. triangles with a corner that is not finite or does not exist are dropped and counted in a warning, as are instances that
///    land outside all numbers and lights that are out of range;
/// 2. points of one mesh that are identical become one, unused points and meshes go, the order of triangles stays;
/// 3. there is at least one material, colours and opacities lie in [0, 1];
/// 4. a scene without triangles has a warning that says so.
[[nodiscard]] scene::Scene tidy(scene::Scene scene);

/// Adds a warning where single precision, in which some parsers read, is coarse for so far a scene. REQUIRES: tidy.
void warnOfCoarseness(scene::Scene& scene);

/// "parent/name" with the level separator taken out of the name; the parent alone for an empty name.
[[nodiscard]] std::string childPath(const std::string& parent, std::string_view name);

[[nodiscard]] Vec3 linearFromSrgb(const Vec3& srgb);

/// "1 triangle", "12 triangles".
[[nodiscard]] std::string counted(std::size_t count, const std::string& noun);

/// What a parser complained about, each thing once, with how often.
class Complaints {
 public:
  void add(const std::string& text);
  /// Appends at most `limit` of them, in the order of first occurrence, then how many more there were.
  void appendTo(std::vector<std::string>& warnings, std::size_t limit = 8) const;
  [[nodiscard]] bool empty() const { return order_.empty(); }
  [[nodiscard]] std::string first() const { return empty() ? std::string() : order_.front(); }

 private:
  std::vector<std::string> order_;
  std::map<std::string, std::size_t> times_;
};

}  // namespace umbrage::io::reader
