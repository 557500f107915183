#version 450 core
// Adds the same to the veils of a pixel, all at once: to the nearest of those for which it counts, from which tinted_reach.frag carries it on to those behind. Whole numbers,
// by atomic operations: exact in any order.
layout(early_fragment_tests) in;
layout(std140, binding = 1) uniform Counted {
  int counted;    // 0 before a surface, 1 behind it, 2 everywhere
  int litLayers;  // so many veils of each pixel are lit by themselves
  int width;      // of the picture
  int opaque;     // 1: what is drawn are pieces of opaque casters, else of veils alone
};
layout(std430, binding = 3) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 4) readonly buffer Veils { uvec2 veil[]; };    // triangle; bits of its depth
layout(std430, binding = 5) buffer Sums { int sums[]; };                // four a veil: opaque surfaces; what veils take of red, green and blue
layout(location = 2) flat in ivec4 weight;

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  uint count = min(own.y, uint(litLayers)), first = 0u;  // before which it lies
  for (uint end = counted != 2 ? count : 0u; first < end;) {
    uint middle = (first + end) / 2u;
    bool isBehind = gl_FragCoord.z <= uintBitsToFloat(veil[own.x + middle].y);
    first = isBehind ? middle + 1u : first;
    end = isBehind ? end : middle;
  }
  ivec4 w = gl_FrontFacing ? weight : -weight;
  // What counts behind is added to the first, and taken away where it ends. A loop, since rasterisers on the processor work out all that stands in branches.
  bool behind = counted == 1;
  uint to = behind ? 0u : first, most = behind ? first : count;
  for (int i = behind ? 2 : 1; i > 0; --i) {
    for (int k = opaque != 0 ? 0 : 1; k < (opaque != 0 ? 1 : 4); ++k) {
      int part = k == 0 ? w.x : k == 1 ? w.y : k == 2 ? w.z : w.w;
      if (to < most && part != 0) atomicAdd(sums[4u * (own.x + to) + uint(k)], part);
    }
    to = first > 0u ? first : count;
    most = count;
    w = -w;
  }
}
