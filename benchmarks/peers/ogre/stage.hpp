#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace umbrage::peers {

using Point = std::array<double, 3>;

struct Part {
  bool casts = true;
  std::vector<Point> corners;
  std::vector<std::array<unsigned, 3>> triangles;
};

struct StageShot {
  std::string name;
  Point eye, target;
  double fovY = 0.0;  ///< radians
  Point light;
};

/// An exported scene (scenes/staged_scene.hpp says the format).
struct Stage {
  std::vector<Part> parts;
  std::vector<StageShot> shots;

  [[nodiscard]] const StageShot* shot(const std::string& name) const;
};

/// Nothing when the file cannot be read or is no such scene.
[[nodiscard]] std::optional<Stage> readStage(const std::string& path);

/// Parts whose centres fall into one square of `side` (seen from above) as one part of at most `limit` corners; a part with more is
/// left as it is. side = 0 leaves all parts as they are.
[[nodiscard]] std::vector<Part> merged(const std::vector<Part>& parts, double side, std::size_t limit);

}  // namespace umbrage::peers
