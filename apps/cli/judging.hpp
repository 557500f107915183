#pragma once

#include "agreement.hpp"
#include "drawing.hpp"
#include "veil_agreement.hpp"

namespace umbrage::cli {

/// The name of the technique by which one with such traits is judged: rays, which see through surfaces or to all of a light where it does.
/// Soft techniques that see no light through surfaces show hard lights as ray_traced does.
[[nodiscard]] const char* truthFor(const shadow::Traits& traits, const View& view);

/// Pixels on which a drawing knows no shadows: they are not judged.
[[nodiscard]] std::size_t unknownPixels(const Drawing& drawing);

/// Per light, how the masks of `a` and `b` differ. The truth is the reference where it is one of the two, so that a lone wrong pixel is no edge
/// of its own.
[[nodiscard]] Result<std::vector<Agreement>> compareDrawings(const Drawing& a, const Drawing& b, const View& view,
                                                             const std::shared_ptr<const shadow::Geometry>& geometry);

/// The same of the light on what lets light through, where both show any; empty: neither does.
[[nodiscard]] Result<std::vector<VeilAgreement>> compareVeilsOf(
    const Drawing& a, const Drawing& b, const View& view, const std::shared_ptr<const shadow::Geometry>& geometry);

/// The first mask of `b`, pale, with every pixel that differs for any light in red, the redder the more; blue where one of them knows
/// no shadows.
[[nodiscard]] image::RgbImage differencePicture(const Drawing& a, const Drawing& b);

}  // namespace umbrage::cli
