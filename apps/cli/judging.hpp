#pragma once

#include "agreement.hpp"
#include "drawing.hpp"

namespace umbrage::cli {

/// The name of the technique by which one with such traits is judged: rays, which see through surfaces or to all of a light where it does.
[[nodiscard]] const char* truthFor(const shadow::Traits& traits);

/// Per light, how the masks of `a` and `b` differ. The truth is the reference where it is one of the two, so that a lone wrong pixel is no edge
/// of its own.
[[nodiscard]] Result<std::vector<Agreement>> compareDrawings(const Drawing& a, const Drawing& b, const View& view,
                                                             const std::shared_ptr<const shadow::Geometry>& geometry);

/// The first mask of `b`, pale, with every pixel that differs for any light in red, the redder the more.
[[nodiscard]] image::RgbImage differencePicture(const Drawing& a, const Drawing& b);

}  // namespace umbrage::cli
