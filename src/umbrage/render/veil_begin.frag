#version 450 core
// Where the veils of each pixel begin; the order of the pixels is left to chance. Those that have places of their own are put there, sorted: the nearest first, equal ones by the
// number of their triangle.
layout(early_fragment_tests) in;  // the stencil knows where there are any
layout(std140, binding = 2) uniform Lists {
  int width;   // of the picture
  uint slots;  // so many veils of a pixel have places of their own
  uint run;    // so many veils are sorted already
};
layout(std430, binding = 2) buffer Counts { uint veils, spilled, most; };
layout(std430, binding = 3) readonly buffer Slots { uvec2 slot[]; };
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) buffer Veils { uvec2 veil[]; };

// Depths are not negative, so their bits order them; nearer is greater.
bool isBefore(uvec2 a, uvec2 b) { return a.y > b.y || (a.y == b.y && (a.x & 0x7fffffffu) < (b.x & 0x7fffffffu)); }

void main() {
  uint i = uint(int(gl_FragCoord.y) * width + int(gl_FragCoord.x)), count = pixel[i].y;
  if (count == 0u) return;
  if (count > slots) atomicMax(most, count);
  uint first = atomicAdd(veils, count);
  pixel[i].x = first;
  if (first + count > uint(veil.length())) return;
  for (uint k = 0u; k < min(count, slots); ++k) {
    uvec2 v = slot[slots * i + k];
    uint to = k;
    for (; to > 0u && isBefore(v, veil[first + to - 1u]); --to) veil[first + to] = veil[first + to - 1u];
    veil[first + to] = v;
  }
}
