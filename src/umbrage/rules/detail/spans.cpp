#include "umbrage/rules/detail/spans.hpp"

#include <algorithm>

namespace umbrage::rules::detail {

using std::chrono::milliseconds;
using study::TimeSpan;

Spans both(std::span<const TimeSpan> a, std::span<const TimeSpan> b) {
  Spans out;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    const TimeSpan span{std::max(a[i].from, b[k].from), std::min(a[i].to, b[k].to)};
    if (span.from < span.to) out.push_back(span);
    a[i].to < b[k].to ? ++i : ++k;
  }
  return out;
}

Spans without(std::span<const TimeSpan> a, std::span<const TimeSpan> b) {
  Spans out;
  std::size_t k = 0;
  for (const TimeSpan& span : a) {
    sun::Instant from = span.from;
    while (k < b.size() && b[k].to <= from) ++k;
    for (std::size_t i = k; i < b.size() && b[i].from < span.to; ++i) {
      if (from < b[i].from) out.push_back({from, b[i].from});
      from = std::max(from, b[i].to);
    }
    if (from < span.to) out.push_back({from, span.to});
  }
  return out;
}

Spans joined(Spans spans) {
  std::sort(spans.begin(), spans.end(), [](const TimeSpan& a, const TimeSpan& b) { return a.from < b.from; });
  Spans out;
  for (const TimeSpan& span : spans) {
    if (!out.empty() && span.from <= out.back().to)
      out.back().to = std::max(out.back().to, span.to);
    else if (span.from < span.to)
      out.push_back(span);
  }
  return out;
}

milliseconds total(std::span<const TimeSpan> spans) {
  milliseconds sum{0};
  for (const TimeSpan& span : spans) sum += span.length();
  return sum;
}

milliseconds longest(std::span<const TimeSpan> spans) {
  milliseconds most{0};
  for (const TimeSpan& span : spans) most = std::max(most, span.length());
  return most;
}

Spans atLeast(Spans spans, milliseconds least) {
  std::erase_if(spans, [&](const TimeSpan& span) { return span.length() < least; });
  return spans;
}

}  // namespace umbrage::rules::detail
