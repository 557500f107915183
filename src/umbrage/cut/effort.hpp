#pragma once

#include <atomic>
#include <cstdint>

namespace umbrage::cut {

/// How much work cutting may take, shared by all threads at it: a scene whose shadows cross everywhere has as many pieces as the square of its edges, and
/// must end with an error, not with the machine's memory.
class Effort {
 public:
  /// Steps are borders of shadows looked at, some 10 ns each; pieces are polygons or nodes of trees.
  struct Limits {
    std::int64_t steps = std::int64_t{1} << 34;
    std::int64_t pieces = std::int64_t{1} << 23;
  };
  Effort() : Effort(Limits{}) {}
  explicit Effort(const Limits& limits) : steps_(limits.steps), pieces_(limits.pieces) {}

  /// False when there is not so much left: then stop.
  [[nodiscard]] bool spendSteps(std::int64_t count) { return spend(steps_, count); }
  [[nodiscard]] bool spendPieces(std::int64_t count) { return spend(pieces_, count); }

 private:
  static bool spend(std::atomic<std::int64_t>& left, std::int64_t count) {
    return left.fetch_sub(count, std::memory_order_relaxed) >= count;
  }
  std::atomic<std::int64_t> steps_, pieces_;
};

}  // namespace umbrage::cut
