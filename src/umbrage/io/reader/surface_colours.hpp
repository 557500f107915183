#pragma once

#include <string_view>

#include "umbrage/math/vec.hpp"

namespace umbrage::io::reader {

/// The colour (linear RGB) of a semantic surface or city object type of CityJSON; a neutral one for types not known.
[[nodiscard]] Vec3 colourOfType(std::string_view type);

}  // namespace umbrage::io::reader
