#pragma once

#include <memory>
#include <string>
#include <vector>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// Every technique of this build, the CPU's first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques();

/// A technique ready to be prepared, and why it was taken.
struct Chosen {
  std::unique_ptr<shadow::Technique> technique;
  std::string reason;
  std::string renderer;  ///< the GL renderer string, where graphics were looked for; else empty
};

/// By name, or "auto": where surfaces let light through (`veils`) transparent_cpu, else zpass on a GPU and hybrid_cpu without one.
/// Errors: usage for an unknown name, device for one that cannot run here.
[[nodiscard]] Result<Chosen> chooseTechnique(const std::string& name, bool veils = false);

/// A name of a technique, or "auto".
[[nodiscard]] Result<std::string> parseTechnique(const std::string& word);

}  // namespace umbrage::cli
