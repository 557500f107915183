#pragma once

#include <memory>
#include <string>
#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// Every technique of this build, the CPU's first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();

/// What the OpenGL techniques would run on.
struct Graphics {
  std::string renderer;   ///< the GL renderer string; empty: no graphics
  bool software = false;  ///< it runs on the CPU
  std::string reason;     ///< why there is none
};
[[nodiscard]] Graphics findGraphics();

/// A technique ready to be prepared, and why it was taken.
struct Chosen {
  std::unique_ptr<shadow::Technique> technique;
  std::string reason;
};

/// By name, or "auto": zpass on a GPU, else ray_traced. Errors: usage for an unknown name, device for one that cannot
/// run here.
[[nodiscard]] Result<Chosen> chooseTechnique(const std::string& name);

/// A name of a technique, or "auto".
[[nodiscard]] Result<std::string> parseTechnique(const std::string& word);

}  // namespace umbrage::cli
