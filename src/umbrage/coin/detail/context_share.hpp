#pragma once

#include <cstdint>

#include "umbrage/coin/detail/stamp.hpp"

namespace umbrage::coin::detail {

/// What an OpenGL context has besides its window's own: one for all nodes of this room.
struct ContextShare {
  std::uint32_t cacheContext = 0;  ///< under which Coin keeps what it makes inside shadow groups
  Stamp stamp;
};

/// By Coin's name for the context that is current; made when first asked for, gone when Coin is told that the context goes
/// (SoContextHandler::destructingContext, as SoQt does). REQUIRES: OpenGL 4.5 (checkTarget).
[[nodiscard]] ContextShare& shareOf(std::uint32_t cacheContext);

}  // namespace umbrage::coin::detail
