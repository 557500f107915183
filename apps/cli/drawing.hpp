#pragma once

#include <memory>

#include "choice.hpp"
#include "options.hpp"

namespace umbrage::cli {

/// A frame shaded by one technique.
struct Drawing {
  shadow::Traits traits;
  std::string reason;    ///< why this technique
  std::string renderer;  ///< the GL renderer string, where graphics were looked for
  shadow::Shading shading;
  double createMs = 0.0, prepareMs = 0.0, shadeMs = 0.0;
};

/// `technique`: a name or "auto".
[[nodiscard]] Result<Drawing> draw(const std::string& technique,
                                   const std::shared_ptr<const shadow::Geometry>& geometry, const View& view,
                                   const Console& console);

/// "out.png" -> "out.png" for one light, "out-0.png", "out-1.png", ... for several.
[[nodiscard]] std::vector<std::string> maskFiles(const std::string& path, std::size_t lights);

}  // namespace umbrage::cli
