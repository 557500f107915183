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
  double createMs = 0.0, prepareMs = 0.0;
  double shadeMs = 0.0;    ///< the median of the frames
  std::size_t frames = 1;  ///< that were drawn to be timed
};

struct DrawOptions {
  std::size_t frames =
      1;  ///< more: one that is not timed, then at most so many, and no more once they have taken some seconds
  bool areasAsCentres =
      false;  ///< to a technique that knows no light with an extent such a light is its centre; else it is refused
};

/// `technique`: a name or "auto".
[[nodiscard]] Result<Drawing> draw(const std::string& technique,
                                   const std::shared_ptr<const shadow::Geometry>& geometry, const View& view,
                                   const Console& console, const DrawOptions& options = {});

/// "out.png" -> "out.png" for one light, "out-0.png", "out-1.png", ... for several.
[[nodiscard]] std::vector<std::string> maskFiles(const std::string& path, std::size_t lights);

}  // namespace umbrage::cli
