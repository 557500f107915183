#pragma once

#include <memory>
#include <string>
#include <vector>

#include "technique_options.hpp"
#include "umbrage/shadow/technique.hpp"

namespace umbrage::cli {

/// Every technique of this build, the CPU's first.
[[nodiscard]] std::vector<shadow::TechniqueEntry> allTechniques(const TechniqueOptions& options = {});

/// A technique ready to be prepared, and why it was taken.
struct Chosen {
  std::unique_ptr<shadow::Technique> technique;
  std::string reason;
  std::string renderer;  ///< the GL renderer string, where graphics were looked for; else empty
};

/// What a picture asks of its technique.
struct Needs {
  bool tinted = false;  ///< there are surfaces that let light through
  bool soft = false;    ///< there are lights with an extent
};

/// By name, or "auto": soft_cpu or transparent_cpu where they are needed, else zpass on a GPU and hybrid_cpu without one.
/// Errors: usage for an unknown name, device for one that cannot run here.
[[nodiscard]] Result<Chosen> chooseTechnique(const std::string& name, Needs needs = {},
                                             const TechniqueOptions& options = {});

/// A name of a technique, or "auto".
[[nodiscard]] Result<std::string> parseTechnique(const std::string& word);

}  // namespace umbrage::cli
