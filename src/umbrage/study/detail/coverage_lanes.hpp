// Stretches of hours that are covered, over a kind of lanes. Included within the namespace of that kind, before hours_cover.hpp.

inline int lowestBit(std::uint32_t bits) { return __builtin_ctz(bits); }

inline bool isCovered(const Coverage& c, float from, float to) {
  const Lanes x(from), y(to);
  std::uint32_t found = 0;
  for (int i = 0; i < c.count; i += 8) found |= bits((load(c.from + i) <= x) & (load(c.to + i) >= y));
  return found != 0;
}

// What is covered at the beginning and at the end of a stretch is cut off.
inline void cutCovered(const Coverage& c, float& from, float& to) {
  const Lanes x(from), y(to);
  for (int i = 0; i < c.count; i += 8) {
    const Lanes a = load(c.from + i), b = load(c.to + i);
    const std::uint32_t atBegin = bits((a <= x) & (b > x)), atEnd = bits((a < y) & (b >= y));
    if (atBegin != 0) from = c.to[i + lowestBit(atBegin)];
    if (atEnd != 0) to = c.from[i + lowestBit(atEnd)];
  }
}

inline bool isFull(const Coverage& c, float first, float last) {
  return c.count == 1 && c.from[0] <= first + 1e-6f && c.to[0] >= last - 1e-6f;
}

// The bins that lie in a stretch, up to a ten thousandth.
inline void fillBins(Coverage& c, float from, float to) {
  const float a = (from - c.first) * c.binsPerUnit - 1e-4f, b = (to - c.first) * c.binsPerUnit + 1e-4f;
  int i = static_cast<int>(a), k = static_cast<int>(b);
  if (static_cast<float>(i) < a) ++i;
  if (i < 0) i = 0;
  if (k > 64) k = 64;
  if (k > i) c.bins |= (~std::uint64_t{0} >> (64 - (k - i))) << i;
}

inline void addCovered(Coverage& c, float from, float to, void (*grow)(Coverage&)) {
  const Lanes low(from - kJoin), high(to + kJoin);
  int i = 0, k = 0;
  std::uint32_t known = 0;
  for (int n = 0; n < c.count; n += 8) {
    const Lanes a = load(c.from + n), b = load(c.to + n);
    i += __builtin_popcount(bits(b < low));
    k += __builtin_popcount(bits(a <= high));
    known |= bits((a <= Lanes(from)) & (b >= Lanes(to)));
  }
  if (known != 0) return;
  if (k > i) {  // it joins stretches i to k - 1
    if (c.from[i] < from) from = c.from[i];
    if (c.to[k - 1] > to) to = c.to[k - 1];
  }
  const int by = i - k + 1;
  if (c.count < 8) {  // all in one register, so that no load waits for small stores
    store(c.from, replaced(load(c.from), i, by, from, kNever));
    store(c.to, replaced(load(c.to), i, by, to, kNever));
  } else {
    if (by == 1 && c.count + 1 > c.capacity) grow(c);
    const int tail = c.count - (k > i ? k : i);
    const int source = k > i ? k : i;
    __builtin_memmove(c.from + i + 1, c.from + source, static_cast<std::size_t>(tail) * sizeof(float));
    __builtin_memmove(c.to + i + 1, c.to + source, static_cast<std::size_t>(tail) * sizeof(float));
    c.from[i] = from, c.to[i] = to;
  }
  c.count += by;
  if (c.count >= 8 || by < 0)
    for (int n = c.count; n < c.count + 8 - (by < 0 ? by : 0); ++n) c.from[n] = c.to[n] = kNever;
  fillBins(c, from, to);
}
