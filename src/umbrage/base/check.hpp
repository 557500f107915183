#pragma once

namespace umbrage::detail {
[[noreturn]] void checkFailed(const char* condition, const char* file, int line, const char* message);
}

/// The caller's bug: prints the condition, the place and the reason, then aborts. Never for the world's faults (see error.hpp).
#define UMBRAGE_CHECK(condition, message) \
  (static_cast<bool>(condition) ? void(0) : ::umbrage::detail::checkFailed(#condition, __FILE__, __LINE__, message))
