#version 450 core
// Adds the same to the veils of a pixel, all at once: to the nearest of those for which it counts, from which tinted_reach.frag carries it on to those behind. Whole numbers,
// by atomic operations: exact in any order.
layout(early_fragment_tests) in;
layout(std140, binding = 1) uniform Counted {
  int counted;    // 0 before a surface, 1 behind it, 2 everywhere
  int litLayers;  // so many veils of each pixel are lit by themselves
  int width;      // of the picture
};
layout(std430, binding = 3) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 4) readonly buffer Veils { uvec2 veil[]; };    // triangle; bits of its depth
layout(std430, binding = 5) buffer Sums { int sums[]; };                // four a veil: opaque surfaces; what veils take of red, green and blue
layout(location = 2) flat in ivec4 weight;

void add(uint at, ivec4 w) {
  for (uint k = 0u; k < 4u; ++k)
    if (w[k] != 0) atomicAdd(sums[4u * at + k], w[k]);
}

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  uint count = min(own.y, uint(litLayers));
  if (count == 0u) return;
  ivec4 w = gl_FrontFacing ? weight : -weight;
  if (counted == 2) {
    add(own.x, w);
    return;
  }
  uint first = 0u;  // before which it lies
  while (first < count && gl_FragCoord.z <= uintBitsToFloat(veil[own.x + first].y)) ++first;
  if (counted == 0) {
    if (first < count) add(own.x + first, w);
    return;
  }
  if (first == 0u) return;
  add(own.x, w);
  if (first < count) add(own.x + first, -w);
}
