#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "umbrage/math/vec.hpp"

namespace umbrage::io::reader {

/// How much of a surface there is, over the cells of its texture, row by row from the top; kAll is all of it.
struct CoverageCells {
  static constexpr std::uint16_t kAll = 65535;
  int width = 0, height = 0;
  std::vector<std::uint16_t> values;

  [[nodiscard]] std::uint16_t at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The same in ever larger cells: those of level 0 are the texels, a cell of the next level is the mean of about four.
class Coverage {
 public:
  /// REQUIRES: at least one texel.
  explicit Coverage(CoverageCells texels);

  [[nodiscard]] std::size_t levels() const { return levels_.size(); }
  [[nodiscard]] const CoverageCells& level(std::size_t l) const { return levels_[l]; }
  /// Of the whole texture, 0 to kAll.
  [[nodiscard]] double mean() const { return mean_; }
  [[nodiscard]] bool isUniform() const { return uniform_; }

 private:
  std::vector<CoverageCells> levels_;
  double mean_ = 0.0;
  bool uniform_ = true;
};

enum class Wrap { repeat, mirror, clamp };

/// The cell of `count` in a row that shows cell `index` of a plane without end.
[[nodiscard]] int wrapped(long index, int count, Wrap wrap);

}  // namespace umbrage::io::reader
