#include "umbrage/study/detail/hours_tree.hpp"
#include "umbrage/study/detail/lanes_plain.hpp"

namespace umbrage::study::detail {
namespace plain {
#include "umbrage/study/detail/coverage_lanes.hpp"
#include "umbrage/study/detail/hours_cover.hpp"
}  // namespace plain
void coverPlain(CoverJob& job) { plain::cover(job); }
void addPlain(Coverage& covered, float from, float to, void (*grow)(Coverage&)) {
  plain::addCovered(covered, from, to, grow);
}
}  // namespace umbrage::study::detail
