#include "umbrage/shadow/unshadowed.hpp"

namespace umbrage::shadow {

LightMask whereKnown(LightMask mask, const image::GreyImage& unshadowed, const LightMask& truth) {
  for (std::size_t i = 0; i < unshadowed.size(); ++i) {
    if (unshadowed.pixels()[i] == 0) continue;
    mask.light.pixels()[i] = truth.light.pixels()[i];
    mask.covered.pixels()[i] = truth.covered.pixels()[i];
  }
  return mask;
}

}  // namespace umbrage::shadow
