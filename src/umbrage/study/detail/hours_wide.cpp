// Compiled for processors with AVX2 and FMA; called only where they are there.
#include "umbrage/study/detail/hours_tree.hpp"

#ifdef UMBRAGE_HOURS_WIDE
#include "umbrage/study/detail/lanes_wide.hpp"

namespace umbrage::study::detail {
namespace wide {
#include "umbrage/study/detail/coverage_lanes.hpp"
#include "umbrage/study/detail/hours_cover.hpp"
}  // namespace wide
void coverWide(CoverJob& job) { wide::cover(job); }
}  // namespace umbrage::study::detail
#else
namespace umbrage::study::detail {
void coverWide(CoverJob& job) { coverPlain(job); }
}  // namespace umbrage::study::detail
#endif
