#include "umbrage/io/reader/coverage.hpp"

#include <algorithm>

#include "umbrage/base/check.hpp"

namespace umbrage::io::reader {
namespace {

// The cells of a finer row that one of `to` coarser ones stands for.
struct Part {
  int begin, end;
};
Part partOf(int cell, int from, int to) {
  const auto border = [&](long c) { return static_cast<int>(c * from / to); };
  return {border(cell), border(cell + 1)};
}

std::uint16_t meanOf(const CoverageCells& finer, const Part& columns, const Part& rows) {
  std::uint64_t sum = 0, count = 0;
  for (int y = rows.begin; y < rows.end; ++y)
    for (int x = columns.begin; x < columns.end; ++x, ++count) sum += finer.at(x, y);
  return static_cast<std::uint16_t>((sum + count / 2) / count);
}

CoverageCells coarser(const CoverageCells& finer) {
  CoverageCells cells{std::max(1, finer.width / 2), std::max(1, finer.height / 2), {}};
  cells.values.reserve(static_cast<std::size_t>(cells.width) * static_cast<std::size_t>(cells.height));
  for (int y = 0; y < cells.height; ++y)
    for (int x = 0; x < cells.width; ++x)
      cells.values.push_back(meanOf(finer, partOf(x, finer.width, cells.width), partOf(y, finer.height, cells.height)));
  return cells;
}

}  // namespace

Coverage::Coverage(CoverageCells texels) {
  UMBRAGE_CHECK(texels.width > 0 && texels.height > 0, "texels");
  levels_.push_back(std::move(texels));
  const auto& values = levels_[0].values;
  double sum = 0.0;
  for (const std::uint16_t value : values) sum += value;
  mean_ = sum / double(values.size());
  uniform_ = std::all_of(values.begin(), values.end(), [&](std::uint16_t value) { return value == values[0]; });
  while (!uniform_ && (levels_.back().width > 1 || levels_.back().height > 1))
    levels_.push_back(coarser(levels_.back()));
}

int wrapped(long index, int count, Wrap wrap) {
  if (wrap == Wrap::clamp) return static_cast<int>(std::clamp(index, 0L, long{count} - 1));
  const long period = wrap == Wrap::mirror ? 2L * count : count;
  const long place = (index % period + period) % period;
  return static_cast<int>(place < count ? place : period - 1 - place);
}

}  // namespace umbrage::io::reader
