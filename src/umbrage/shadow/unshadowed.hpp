#pragma once

#include "umbrage/shadow/light_mask.hpp"

namespace umbrage::shadow {

/// `mask` with what it does not know (Shading::unshadowed) taken from `truth`, so that comparing them judges what it knows.
/// REQUIRES: pictures of one size; `unshadowed` may be empty; no tints.
[[nodiscard]] LightMask whereKnown(LightMask mask, const image::GreyImage& unshadowed, const LightMask& truth);

}  // namespace umbrage::shadow
