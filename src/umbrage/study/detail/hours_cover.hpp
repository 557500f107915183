// The traversal, over a kind of lanes. Included within the namespace of that kind (wide or plain), so that files compiled for
// different processors share no function.
//
// Frame: SunLeg's. A box or an edge is seen from the point; the sun moves on F = s (y - height(h) w) = 0, where y is the way to the
// south pole, w the distance from the axis and s the sign that makes F concave. "Hours" are pseudo-angles throughout.

// ---- leaves

// Two quads of a leaf, or one, that may hide the sun from a point within some hours.
struct Task {
  std::uint32_t point, a, b;
  bool two;
  float sideA, sideB;  // negative: seen from outside
  float from, to;
  const ArcDirections* arc;
};

// When they do, per quad; the hours on the inner sides of their edges where these ranges do not tell all.
struct Answer {
  alignas(32) float edgeFrom[8];
  alignas(32) float edgeTo[8];
  float from[2], to[2];
  std::uint32_t found;     // bits 0-3 and 4-7: the quad hides the sun somewhere
  std::uint32_t doubtful;  // bit k: an edge along which the sun rakes; it is left out of the range
  std::uint32_t cut;       // bit k: an edge that lets the sun through in the midst of the range
};

inline Lanes pseudo(Lanes x, Lanes y) { return flipped(Lanes(1.0f) - x / (magnitude(x) + magnitude(y)), y); }

struct Three {
  Lanes x, y, z;
};
inline Lanes dot(const Three& a, const float* b) {
  return fma(a.x, Lanes(b[0]), fma(a.y, Lanes(b[1]), a.z * Lanes(b[2])));
}

// The stretches within [first, last] that satisfy four constraints, each a plain or a wrapped stretch.
inline void addPieces(const float* from, const float* to, float first, float last, Coverage& c,
                      void (*grow)(Coverage&)) {
  float piece[8][2] = {{first, last}};
  int count = 1;
  for (int k = 0; k < 4; ++k) {
    float next[8][2];
    int n = 0;
    const auto keep = [&](float a, float b) {
      if (a < b && n < 8) next[n][0] = a, next[n][1] = b, ++n;
    };
    for (int i = 0; i < count; ++i) {
      const float a = piece[i][0], b = piece[i][1];
      if (from[k] <= to[k]) {
        keep(a > from[k] ? a : from[k], b < to[k] ? b : to[k]);
      } else {
        keep(a, b < to[k] ? b : to[k]);
        keep(a > from[k] ? a : from[k], b);
      }
    }
    count = n;
    __builtin_memcpy(piece, next, sizeof piece);
  }
  for (int i = 0; i < count; ++i) addCovered(c, piece[i][0], piece[i][1], grow);
}

// An edge per lane: lanes 0-3 are quad `a`, 4-7 quad `b`. Without a branch, so that the processor works on several tasks at once.
inline void solve(const CoverJob& job, const Task& task, Answer& answer) {
  const TreeQuad &p = job.quads[task.a], &q = job.quads[task.b];
  const GroupPoint& point = job.points[task.point];
  const auto seen = [&](const float* u, const float* v, int axis) {
    return (load(u, v) - Lanes(point.high[axis])) - Lanes(point.low[axis]);
  };
  const Lanes side = halves(task.sideA, task.sideB);
  const Three corner{seen(p.x, q.x, 0), seen(p.y, q.y, 1), seen(p.z, q.z, 2)};
  const Three next{following(corner.x), following(corner.y), following(corner.z)};
  // With the ends exchanged it is the same with the other sign, bit by bit, so that neighbours share a moment. Of an edge that points
  // to the eye both products are far larger than their difference, hence the care.
  const Three plane{flipped(difference(corner.y, next.z, corner.z, next.y), side),
                    flipped(difference(corner.z, next.x, corner.x, next.z), side),
                    flipped(difference(corner.x, next.y, corner.y, next.x), side)};
  const Lanes al = dot(plane, task.arc->rise), be = dot(plane, task.arc->cosine), ga = dot(plane, task.arc->sine);
  const Lanes zero(0.0f), first(task.from), last(task.to);
  const Lanes d2 = fnma(al, al, fma(be, be, ga * ga));
  const Lanes size = fma(plane.x, plane.x, fma(plane.y, plane.y, plane.z * plane.z));
  const Mask crosses = d2 > zero;
  const Mask raking = magnitude(d2) < Lanes(0.0025f) * size;  // the sun meets this edge at less than 0.05 radians
  const Mask never = without(raking, without(crosses, al < zero)), clear = without(raking, crosses);
  const Lanes d = root(larger(d2, zero));
  const Lanes ab = -al * be, ag = -al * ga;
  const Lanes from = select(clear, pseudo(fma(ga, d, ab), fnma(be, d, ag)), Lanes(-4.0f));
  const Lanes to = select(clear, pseudo(fnma(ga, d, ab), fma(be, d, ag)), Lanes(4.0f));
  // A wrapped stretch whose gap reaches beyond one end of the hours asked for is an ordinary one there.
  const Mask wrapped = from > to;
  const Mask early = wrapped & (from >= last), late = wrapped & (to <= first);
  const Mask split = without(early | late, wrapped);
  const Lanes f = select(split, first, select(early, Lanes(-4.0f), from));
  const Lanes t = select(split, last, select(without(early, late), Lanes(4.0f), to));
  const Lanes low = largestOfFour(larger(f, first)), high = smallestOfFour(smaller(t, last));
  const std::uint32_t none = bits(never | (early & late)), halfA = 0x0fu, halfB = task.two ? 0xf0u : 0u;
  const std::uint32_t alive = ((none & 0x0fu) != 0 ? 0u : halfA) | ((none & 0xf0u) != 0 ? 0u : halfB);
  answer.found = bits(low < high) & alive;
  answer.doubtful = bits(raking), answer.cut = bits(split);
  answer.from[0] = lowHalf(low), answer.from[1] = highHalf(low);
  answer.to[0] = lowHalf(high), answer.to[1] = highHalf(high);
  store(answer.edgeFrom, from), store(answer.edgeTo, to);
}

// Edge by edge, those in doubt in double precision.
inline void addCarefully(const CoverJob& job, const Task& task, Answer& answer, int half, Coverage& covered) {
  float *from = answer.edgeFrom + 4 * half, *to = answer.edgeTo + 4 * half;
  const std::uint32_t doubtful = answer.doubtful >> (4 * half) & 0x0fu;
  if (doubtful != 0 && !job.refine(job.context, job.points[task.point].index, half == 0 ? task.a : task.b, doubtful,
                                   static_cast<std::uint32_t>(task.arc - job.arcs), task.from, task.to, from, to))
    return;
  addPieces(from, to, task.from, task.to, covered, job.grow);
}

inline void take(const CoverJob& job, const Task& task, Answer& answer, Coverage& covered) {
  std::uint32_t found = answer.found;
  if (found == 0) return;
  const float *from = answer.from, *to = answer.to;
  if ((found & 0x0fu) != 0 && isCovered(covered, from[0], to[0])) found &= ~0x0fu;
  if ((found & 0xf0u) != 0 && isCovered(covered, from[1], to[1])) found &= ~0xf0u;
  const std::uint32_t careful = (answer.doubtful | answer.cut) & found;
  if (careful != 0)
    for (int half = 0; half < 2; ++half)
      if ((careful >> (4 * half) & 0x0fu) != 0) {
        addCarefully(job, task, answer, half, covered);
        found &= ~(0x0fu << (4 * half));
      }
  if ((found & 0x11u) == 0x11u && from[0] <= to[1] + kJoin && from[1] <= to[0] + kJoin) {
    addCovered(covered, from[0] < from[1] ? from[0] : from[1], to[0] > to[1] ? to[0] : to[1], job.grow);
    return;
  }
  if ((found & 0x01u) != 0) addCovered(covered, from[0], to[0], job.grow);
  if ((found & 0x10u) != 0) addCovered(covered, from[1], to[1], job.grow);
}

// Tasks are gathered, solved together and then taken.
struct Tasks {
  static constexpr int kMost = 24;
  int count = 0;
  Task task[kMost];
};

inline void finish(CoverJob& job, Tasks& tasks) {
  Answer answers[Tasks::kMost];
  for (int i = 0; i < tasks.count; ++i) solve(job, tasks.task[i], answers[i]);
  for (int i = 0; i < tasks.count; ++i) take(job, tasks.task[i], answers[i], job.covered[tasks.task[i].point]);
  tasks.count = 0;
}

// Lanes whose solid is one of those around the group.
inline std::uint32_t lanesWithin(const CoverJob& job, const TreeLeaf& leaf) {
  std::uint32_t lanes = 0;
  for (std::int32_t i = 0; i < job.withinCount; ++i)
    for (int k = 0; k < 8; ++k) lanes |= static_cast<std::uint32_t>(leaf.solid[k] == job.within[i]) << k;
  return lanes;
}

// Of a leaf's lanes: which are asked from both sides, and which a point may touch.
struct Sides {
  std::uint32_t both, touchable;
};
inline Sides sidesOf(const CoverJob& job, const TreeLeaf& leaf) {
  const std::uint32_t around = job.withinCount > 0 ? lanesWithin(job, leaf) : 0u;
  return {leaf.open | (job.inside ? around : 0u), leaf.open | around};
}

// The quads of a leaf that may hide the sun from a point within some hours become tasks.
inline void askLeaf(CoverJob& job, const TreeLeaf& leaf, const Sides& sides, std::uint32_t k, float from, float to,
                    const ArcDirections* arc, Tasks& tasks) {
  const GroupPoint& point = job.points[k];
  const auto seen = [&](const float* u, int axis) {
    return (load(u) - Lanes(point.high[axis])) - Lanes(point.low[axis]);
  };
  const Lanes nx = load(leaf.nx), ny = load(leaf.ny), nz = load(leaf.nz);
  const Lanes depth = fma(seen(leaf.x, 0), nx, fma(seen(leaf.y, 1), ny, seen(leaf.z, 2) * nz));
  const std::uint32_t front = bits(depth < Lanes(0.0f));
  std::uint32_t left = ((front & ~leaf.flatUp) | sides.both) & leaf.used;
  std::uint32_t near = sides.touchable == 0 ? 0u : bits(magnitude(depth) <= Lanes(job.contact)) & leaf.used;
  for (; near != 0; near &= near - 1) {
    const int i = lowestBit(near);
    const bool closed = (leaf.open >> i & 1u) == 0;
    if (job.touch(job.context, point.index, leaf.quads + static_cast<std::uint32_t>(i), closed, job.covered[k]))
      left &= ~(1u << i);
  }
  while (left != 0) {
    const auto i = static_cast<std::uint32_t>(lowestBit(left));
    left &= left - 1;
    const bool two = left != 0;
    const std::uint32_t other = two ? static_cast<std::uint32_t>(lowestBit(left)) : i;
    left &= left - (two ? 1u : 0u);
    if (tasks.count == Tasks::kMost) finish(job, tasks);
    tasks.task[tasks.count++] = {k,
                                 leaf.quads + i,
                                 leaf.quads + other,
                                 two,
                                 (front >> i & 1u) != 0 ? -1.0f : 1.0f,
                                 (front >> other & 1u) != 0 ? -1.0f : 1.0f,
                                 from,
                                 to,
                                 arc};
  }
}

// The arc for a stretch that begins at `from`, and how far it is good: to `to`, or less.
struct Arc {
  const ArcDirections* directions;
  float to;
};
inline Arc arcFrom(const CoverJob& job, float from, float to) {
  const int count = job.arcCount;
  const float scale = static_cast<float>(count) / (job.last - job.first);
  const auto index = [&](float p) {
    const int i = static_cast<int>((p - job.first) * scale);
    return i < 0 ? 0 : i >= count ? count - 1 : i;
  };
  const ArcDirections* best = job.arcs + index(0.5f * (from + to));
  if (best->low <= from && best->high >= to) return {best, to};
  // The last one that reaches back to the beginning.
  int i = index(from);
  for (int step = count / 2; step > 0; step /= 2)
    while (i + step < count && job.arcs[i + step].low <= from) i += step;
  const float good = job.arcs[i].high, least = from + 0.5f / scale;
  const float end = good > least ? good : least;
  return {job.arcs + i, end < to ? end : to};
}

// ---- nodes

// Of a group's state: bins that all its points have covered.
inline std::uint64_t commonBins(const CoverJob& job, std::uint32_t live) {
  std::uint64_t all = ~std::uint64_t{0};
  for (; live != 0; live &= live - 1) all &= job.covered[lowestBit(live)].bins;
  return all;
}

struct Entry {
  std::int32_t child;
  float from, to, distance;
};

struct NodeConstants {
  float sign, slope;          // of `rise`: its sign and magnitude
  float turnFirst, turnWest;  // sign * cosine, sign * sine
  float sinAbs, cosAbs;
  bool facing;     // no point faces all ways
  float steepest;  // of the cone
  float radius;    // of the group, seen along the axis
  float scale;     // bins per unit
};

inline NodeConstants constantsOf(const CoverJob& job) {
  NodeConstants k{};
  k.sign = job.rise < 0.0f ? -1.0f : 1.0f;
  k.slope = k.sign * job.rise;
  k.turnFirst = k.sign * job.cosine, k.turnWest = k.sign * job.sine;
  k.sinAbs = __builtin_fabsf(job.sinLatitude), k.cosAbs = __builtin_fabsf(job.cosLatitude);
  k.steepest = k.slope + __builtin_fabsf(job.cosine) + __builtin_fabsf(job.sine);
  k.facing = job.normal[3] + job.normal[4] + job.normal[5] > 0.0f;
  const float tall = k.sinAbs * job.extent[1] + k.cosAbs * job.extent[2];
  k.radius = __builtin_sqrtf(tall * tall + job.extent[0] * job.extent[0]);
  k.scale = 64.0f / (job.last - job.first);
  return k;
}

// Boxes as they are seen: which may hide the sun, and at which hours.
struct Look {
  std::uint32_t left;
  Lanes from, to;
};

// The ways that eyes face: a vector, and its absolute values.
struct Facing {
  Lanes first, west, south, east, north, up;
};

// `first`, `west`, `south`: the boxes' middles from the eyes; then their extents.
[[gnu::always_inline]] inline Look look(const CoverJob& job, const NodeConstants& k, const Facing& facing, float apart,
                                        Lanes first, Lanes west, Lanes south, Lanes ex, Lanes ey, Lanes ez,
                                        Lanes flat) {
  const Lanes zero(0.0f);
  const Lanes sinA(k.sinAbs), cosA(k.cosAbs), slope(k.slope);
  const Lanes w2 = fma(first, first, fma(west, west, Lanes(1e-12f)));
  const Lanes iw = inverseRoot(w2), w = w2 * iw, wb = first * iw, wc = west * iw;
  // How far above the cone of the sun's way the middle lies.
  const Lanes f = fma(south, Lanes(k.sign), -fma(first, Lanes(k.turnFirst), fma(west, Lanes(k.turnWest), slope * w)));
  const Lanes slack = fma(Lanes(job.error), w + flat, Lanes(1e-4f));
  const Lanes reach = w - flat;
  const Mask outside = reach > Lanes(1e-3f);
  const Lanes bend = (flat * flat) * (Lanes(0.501f * k.slope) * roughInverse(larger(reach, Lanes(1e-3f))));
  // The gradient of f along first and west; along south it is the sign.
  const Lanes gb = -fma(slope, wb, Lanes(k.turnFirst)), gc = -fma(slope, wc, Lanes(k.turnWest));
  const Lanes sl(job.sinLatitude), cl(job.cosLatitude), ssl(k.sign * job.sinLatitude), scl(k.sign * job.cosLatitude);
  const Lanes gx = -gc, gy = -fma(sl, gb, scl), gz = fms(cl, gb, ssl);
  const Lanes spread = fma(magnitude(gx), ex, fma(magnitude(gy), ey, fma(magnitude(gz), ez, slack)));
  const Lanes loose = fma(cosA, ey, fma(sinA, ez, fma(Lanes(k.steepest), flat, slack)));
  Mask ok = (magnitude(f) <= loose) & (f + spread >= zero);
  ok = ok & ((f <= spread + bend) | without(outside, ok));
  // Above the horizon, and before the plane that the points face from.
  ok = ok & (fma(first, cl, fnma(south, sl, ez)) > zero);
  if (k.facing) {
    Lanes ahead = fma(first, facing.first, fma(west, facing.west, south * facing.south));
    if (apart > 0.0f) ahead = fma((w + magnitude(south)) + (ex + ey) + ez, Lanes(apart), ahead);
    ok = ok & (fma(ex, facing.east, fma(ey, facing.north, fma(ez, facing.up, ahead))) > zero);
  }
  Look out{bits(ok), zero, zero};
  if (out.left == 0) return out;
  // Which hours: the box reaches rt to the sides and rr towards and away from the axis; of it only what lies near the
  // cone counts.
  const Lanes along = fma(sinA, ey, cosA * ez);
  const Lanes rr = fma(magnitude(wc), ex, magnitude(wb) * along),
              rt = fma(magnitude(wb), ex, magnitude(wc) * along) * Lanes(1.00001f);
  const Lanes near = w - rr, far = w + rr;
  const Mask around = near <= Lanes(1e-3f);
  // t = L g + (t - L g), where g over the box is known to be -f to the slack and the bend, and L leaves out the vertical.
  const Lanes tx = -wb, ty = wc * sl, tz = -wc * cl;
  const Lanes lambda = tz * gz * inverse(fma(gz, gz, Lanes(1e-4f)));
  const Lanes rest = fma(magnitude(fnma(lambda, gx, tx)), ex,
                         fma(magnitude(fnma(lambda, gy, ty)), ey, magnitude(fnma(lambda, gz, tz)) * ez));
  const Lanes wide = fma(fma(magnitude(lambda), bend + slack, rest), Lanes(1.0001f), Lanes(1e-4f));
  const Lanes centre = -lambda * f;
  const Lanes tl = select(outside, larger(-rt, centre - wide), -rt),
              th = select(outside, smaller(rt, centre + wide), rt);
  out.left &= bits(around | (tl <= th));
  if (out.left == 0) return out;
  const Lanes dl = selectNegative(tl, near, far), dh = selectNegative(th, far, near);
  const Lanes ax = fms(wb, dl, wc * tl), ay = fma(wc, dl, wb * tl), bx = fms(wb, dh, wc * th),
              by = fma(wc, dh, wb * th);
  const Lanes one(1.0f), margin(2e-6f), begin(job.first), end(job.last);
  const Lanes from = flipped(one - ax * inverse(magnitude(ax) + magnitude(ay)), ay) - margin;
  const Lanes to = flipped(one - bx * inverse(magnitude(bx) + magnitude(by)), by) + margin;
  const Mask wrapped = from > to, beforeEnd = from <= end, afterBegin = to >= begin;
  const Mask meets = around | (wrapped & (beforeEnd | afterBegin)) | without(wrapped, beforeEnd & afterBegin);
  out.left &= bits(meets);
  const Mask all = around | wrapped;
  out.from = larger(select(all, begin, from), begin), out.to = smaller(select(all, end, to), end);
  return out;
}

// Puts the children that may hide the sun at hours not yet covered onto the stack, the nearest on top. Returns the new
// top.
template <class Leaf>
inline int openNode(const CoverJob& job, const NodeConstants& k, const TreeNode* nodes, const Leaf* leaves,
                    const TreeNode& node, std::uint64_t covered, Entry* stack, int top) {
  const Lanes first = load(node.first) - Lanes(job.middle[0]), west = load(node.west) - Lanes(job.middle[1]),
              south = load(node.south) - Lanes(job.middle[2]);
  const float* n = job.normal;
  const Facing facing{Lanes(n[0]), Lanes(n[1]), Lanes(n[2]), Lanes(n[3]), Lanes(n[4]), Lanes(n[5])};
  const Look seen = look(job, k, facing, job.spread, first, west, south, load(node.east) + Lanes(job.extent[0]),
                         load(node.north) + Lanes(job.extent[1]), load(node.up) + Lanes(job.extent[2]),
                         load(node.flat) + Lanes(k.radius));
  std::uint32_t left = seen.left;
  if (left == 0) return top;
  const Lanes scale(k.scale), begin(job.first);
  left &= ~allIn((seen.from - begin) * scale, (seen.to - begin) * scale, covered);
  if (left == 0) return top;
  alignas(32) float a[8], b[8], distance[8];
  store(a, seen.from), store(b, seen.to);
  store(distance, fma(south, south, fma(first, first, west * west)));
  const int bottom = top;
  for (; left != 0; left &= left - 1) {
    const int i = lowestBit(left);
    const Entry entry{node.child[i], a[i], b[i], distance[i]};
    const char* ahead = entry.child < 0 ? reinterpret_cast<const char*>(leaves + ~entry.child)
                                        : reinterpret_cast<const char*>(nodes + entry.child);
    for (int line = 0; line < int(sizeof(Leaf) < 256 ? 2 : 4); ++line) __builtin_prefetch(ahead + 64 * line);
    int at = top++;
    for (; at > bottom && stack[at - 1].distance < entry.distance; --at) stack[at] = stack[at - 1];
    stack[at] = entry;
  }
  return top;
}

inline std::uint32_t notFull(const CoverJob& job, std::uint32_t of) {
  std::uint32_t live = 0;
  for (; of != 0; of &= of - 1) {
    const int k = lowestBit(of);
    if (!isFull(job.covered[k], job.first, job.last)) live |= 1u << k;
  }
  return live;
}

// The group's points, each seen alone: a leaf that one of them must open is of no use to most others.
inline Look lookFromEach(const CoverJob& job, const NodeConstants& k, const TreeLeaf& leaf) {
  const auto& n = job.facing;
  const Facing facing{load(n[0]), load(n[1]), load(n[2]), load(n[3]), load(n[4]), load(n[5])};
  return look(job, k, facing, 0.0f, Lanes(leaf.first) - load(job.eyeFirst), Lanes(leaf.west) - load(job.eyeWest),
              Lanes(leaf.south) - load(job.eyeSouth), Lanes(leaf.east + job.margin), Lanes(leaf.north + job.margin),
              Lanes(leaf.up + job.margin), Lanes(leaf.flat + 2.0f * job.margin));
}

// Returns which points are left.
inline std::uint32_t openLeaf(CoverJob& job, const NodeConstants& constants, const Entry& entry, std::uint32_t live) {
  const TreeLeaf& leaf = job.leaves[~entry.child];
  const Look seen = lookFromEach(job, constants, leaf);
  std::uint32_t left = seen.left & live;
  if (left == 0) return live;
  const Sides sides = sidesOf(job, leaf);
  alignas(32) float begin[8], end[8];
  store(begin, seen.from), store(end, seen.to);
  Tasks tasks;
  const std::uint32_t asked = left;
  for (; left != 0; left &= left - 1) {
    const int k = lowestBit(left);
    cutCovered(job.covered[k], begin[k], end[k]);
    for (float from = begin[k]; from < end[k];) {
      const Arc arc = arcFrom(job, from, end[k]);
      askLeaf(job, leaf, sides, static_cast<std::uint32_t>(k), from, arc.to, arc.directions, tasks);
      from = arc.to;
    }
  }
  finish(job, tasks);
  return (live & ~asked) | notFull(job, asked);
}

// When balls hide the sun: where its direction is nearer to a ball's middle than the ball's edge is. Never more than the balls do, whatever the
// rounding: each sum below is made less by more than its error.
inline void openBalls(CoverJob& job, const TreeBalls& balls, std::uint32_t live) {
  const Lanes radius = load(balls.radius), zero(0.0f), small(4e-6f), end(2e-6f);
  for (std::uint32_t left = live; left != 0; left &= left - 1) {
    const int k = lowestBit(left);
    const Lanes x = load(balls.first) - Lanes(job.eyeFirst[k]), y = load(balls.west) - Lanes(job.eyeWest[k]),
                z = load(balls.south) - Lanes(job.eyeSouth[k]);
    const Lanes tangent2 = fma(x, x, fma(y, y, z * z)) - radius * radius;  // to where lines from the eye touch the ball
    const Lanes least = root(larger(tangent2, zero)) * Lanes(job.longest);
    const Lanes size = magnitude(x) + magnitude(y) + magnitude(z) + least;
    const Lanes al = fms(z, Lanes(job.rise), fma(magnitude(z), Lanes(job.error), fma(size, small, least)));
    const Lanes be = fma(z, Lanes(job.cosine), x), ga = fma(z, Lanes(job.sine), y);
    const Lanes d2 = fnma(al, al, fma(be, be, ga * ga));
    const Lanes d = root(larger(d2, zero)), ab = -al * be, ag = -al * ga;
    const Lanes from = larger(pseudo(fma(ga, d, ab), fnma(be, d, ag)) + end, Lanes(job.first));
    const Lanes to = smaller(pseudo(fnma(ga, d, ab), fma(be, d, ag)) - end, Lanes(job.last));
    std::uint32_t hidden = bits((d2 > zero) & (tangent2 > zero) & (radius > zero) & (from < to));
    if (hidden == 0) continue;
    alignas(32) float a[8], b[8];
    store(a, from), store(b, to);
    for (; hidden != 0; hidden &= hidden - 1) {
      const int i = lowestBit(hidden);
      addCovered(job.covered[k], a[i], b[i], job.grow);
    }
  }
}

// Through a tree, the nearest first, leaving out what hides the sun only when it is hidden for all points that are live;
// open(leaf, entry) takes a leaf and returns who is left.
template <class Leaf, class Open>
inline std::uint32_t walk(CoverJob& job, const NodeConstants& constants, const TreeNode* nodes, std::int32_t root,
                          const Leaf* leaves, std::uint32_t live, const Open& openLeaf) {
  Entry stack[512];
  int top = 0, last = 0;
  stack[top++] = {root, job.first, job.last, 0.0f};
  std::uint64_t bins = commonBins(job, live);
  while (top > 0 && live != 0) {
    const Entry entry = stack[--top];
    if ((live >> last & 1u) == 0 || isCovered(job.covered[last], entry.from, entry.to)) {
      bool open = false;  // for any of the others?
      for (std::uint32_t left = live; left != 0 && !open; left &= left - 1) {
        const int k = lowestBit(left);
        if (!isCovered(job.covered[k], entry.from, entry.to)) open = true, last = k;
      }
      if (!open) continue;
    }
    if (entry.child >= 0) {
      top = openNode(job, constants, nodes, leaves, nodes[entry.child], bins, stack, top);
    } else {
      live = openLeaf(entry, live);
      bins = commonBins(job, live);
    }
  }
  return live;
}

inline void cover(CoverJob& job) {
  const NodeConstants constants = constantsOf(job);
  std::uint32_t live = notFull(job, (1u << job.count) - 1u);
  if (job.ballNodes != nullptr)
    live = walk(job, constants, job.ballNodes, job.ballRoot, job.balls, live,
                [&](const Entry& entry, std::uint32_t alive) {
                  openBalls(job, job.balls[~entry.child], alive);
                  return notFull(job, alive);
                });
  walk(job, constants, job.nodes, job.root, job.leaves, live,
       [&](const Entry& entry, std::uint32_t alive) { return openLeaf(job, constants, entry, alive); });
}
