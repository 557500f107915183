#pragma once

#include <functional>

#include "umbrage/shadow/technique.hpp"

namespace umbrage::techniques::detail {

using Maker = std::function<Result<std::unique_ptr<shadow::Technique>>()>;

/// Soft shadows as the mean of exact hard ones: by `opaque`, or by `tinted` where casters let light through.
struct SoftParts {
  std::string name;
  std::string summary;
  Maker opaque, tinted;
};
[[nodiscard]] shadow::TechniqueEntry softTechnique(SoftParts parts);

}  // namespace umbrage::techniques::detail
