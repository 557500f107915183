#pragma once

#include <cstdint>

#include "umbrage/base/error.hpp"

namespace umbrage::coin::detail {

/// Under what name Coin keeps what it makes inside shadow groups in an OpenGL context, by its name for the context itself. One for all nodes of this room;
/// forgotten when Coin is told that the context goes (SoContextHandler::destructingContext, as SoQt does).
[[nodiscard]] std::uint32_t ownCacheContext(std::uint32_t cacheContext);

/// Errors: ErrorCode::device when the current context, or the framebuffer that is bound, cannot take shadows.
[[nodiscard]] Result<void> checkTarget();

}  // namespace umbrage::coin::detail
