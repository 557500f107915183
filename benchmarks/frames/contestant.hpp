#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scenes/staged_scene.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::benchmarks {

/// A scene on the stage, as contestants get it.
struct Stage {
  StagedScene staged;
  std::shared_ptr<const shadow::Geometry> geometry;
  std::filesystem::path file;  ///< exported(staged)
};

/// Somebody who draws one shot, frame by frame.
class Contestant {
 public:
  virtual ~Contestant() = default;
  /// Draws a frame with the light moved by `shift` along x, waits until it is finished, and returns what that took in milliseconds.
  [[nodiscard]] virtual Result<double> frame(double shift) = 0;
  /// Medians of the parts of a frame, by name; empty where they are not known.
  [[nodiscard]] virtual std::map<std::string, double> phases() const { return {}; }
  /// Makes a picture of the last frame, where it can.
  [[nodiscard]] virtual Result<void> picture(const std::filesystem::path&) { return {}; }
};

/// A kind of contestant, for every shot anew.
struct Entry {
  std::string name;
  std::function<Result<std::unique_ptr<Contestant>>(const Stage&, const Shot&)> enter;
};

/// A technique's whole frame: everything that a moved light demands, until mask and surface lie in main memory. `shaded`: and then the picture,
/// lit and coloured on the processor; its name ends in "_picture".
[[nodiscard]] Entry techniqueEntry(const shadow::TechniqueEntry& technique, bool shaded = false);

/// Bare Embree shadow rays (bare_rays.hpp) from a depth buffer that costs nothing here: no frame, but the least that tracing can cost.
[[nodiscard]] Entry bareRaysEntry();

/// Another program, run by the shell as `command`, in which {scene}, {shot} and {picture} (a .ppm beside the scene's file) stand for
/// the shot's. It answers "ready" and then, to each line "frame SHIFT", milliseconds; it writes the picture when its input ends.
[[nodiscard]] Entry peerEntry(std::string name, std::string command);

}  // namespace umbrage::benchmarks
