#include "umbrage/base/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace umbrage::detail {

void checkFailed(const char* condition, const char* file, int line, const char* message) {
  std::fprintf(stderr, "umbrage: %s:%d: check failed: %s (%s)\n", file, line, condition, message);
  std::abort();
}

}  // namespace umbrage::detail
