#pragma once

#include <algorithm>
#include <cstddef>
#include <thread>
#include <vector>

namespace umbrage::shadow {

/// `wanted`, or one a processor when it is 0.
inline unsigned threadCount(unsigned wanted) {
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// Calls fn(part, begin, end) for `parts` parts of [0, count), each in a thread of its own, the last in this one. Borders are
/// multiples of `grain`.
template <class Fn>
void inParts(std::size_t count, std::size_t grain, unsigned parts, const Fn& fn) {
  const std::size_t grains = (count + grain - 1) / grain;
  const auto border = [&](std::size_t part) { return std::min(count, grains * part / parts * grain); };
  std::vector<std::jthread> threads;
  for (unsigned part = 0; part + 1 < parts; ++part)
    threads.emplace_back([&fn, part, begin = border(part), end = border(part + 1)] { fn(part, begin, end); });
  fn(parts - 1, border(parts - 1), count);
}

}  // namespace umbrage::shadow
