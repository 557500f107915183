#pragma once

#include <string_view>

#include "umbrage/base/error.hpp"

namespace umbrage {

/// Refuses JSON whose lists and objects are nested in each other more than `most` deep, which would exhaust the stack of who walks it. Looks at
/// brackets and texts alone: whether it is JSON at all is the parser's to say. Errors: input.
[[nodiscard]] Result<void> checkJsonDepth(std::string_view json, int most);

}  // namespace umbrage
