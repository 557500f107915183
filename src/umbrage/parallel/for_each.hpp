#pragma once

#include <functional>

#include "umbrage/base/error.hpp"

namespace umbrage::parallel {

/// Calls work(i) for every i in [0, count), in as many threads as the machine has processors; returns when all are done.
/// Errors: ErrorCode::device when memory runs out.
[[nodiscard]] Result<void> forEach(int count, const std::function<void(int)>& work);

}  // namespace umbrage::parallel
