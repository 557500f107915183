#pragma once

#include <functional>
#include <string_view>

namespace umbrage {

/// Long work reports the fraction done in [0, 1] and what it does; the sink returns false to cancel. May be empty.
/// Called from the thread that called the long function, never from workers.
using ProgressSink = std::function<bool(double fraction, std::string_view what)>;

/// True to go on. An empty sink never cancels.
inline bool reportProgress(const ProgressSink& sink, double fraction, std::string_view what) {
  return !sink || sink(fraction, what);
}

}  // namespace umbrage
