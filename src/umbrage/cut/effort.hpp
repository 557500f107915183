#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace umbrage::cut {

/// How much work cutting may take, shared by all threads at it: a scene whose shadows cross everywhere has as many pieces as the square of its edges, and
/// must end with an error, not with the machine's memory.
class Effort {
 public:
  /// Steps are borders of shadows and casters looked at, some 20 ns each; pieces are polygons or nodes of trees.
  struct Limits {
    std::int64_t steps, pieces;
  };
  /// Some 30 times what a detailed building takes: about a minute and 1 GiB, and more for more triangles.
  [[nodiscard]] static Limits usual(std::size_t triangles) {
    const auto n = static_cast<std::int64_t>(triangles);
    return {(std::int64_t{1} << 31) + (n << 14), (std::int64_t{1} << 22) + 8 * n};
  }
  explicit Effort(const Limits& limits) : steps_(limits.steps), pieces_(limits.pieces) {}

  /// False when there is not so much left: then stop.
  [[nodiscard]] bool spendSteps(std::int64_t count) { return spend(steps_, count); }
  [[nodiscard]] bool spendPieces(std::int64_t count) { return spend(pieces_, count); }
  /// Below 0 when more was asked for.
  [[nodiscard]] std::int64_t stepsLeft() const { return steps_.load(std::memory_order_relaxed); }

 private:
  static bool spend(std::atomic<std::int64_t>& left, std::int64_t count) {
    return left.fetch_sub(count, std::memory_order_relaxed) >= count;
  }
  std::atomic<std::int64_t> steps_, pieces_;
};

}  // namespace umbrage::cut
