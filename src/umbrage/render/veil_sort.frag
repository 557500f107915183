#version 450 core
// Sorts runs of `run` veils of each pixel: the nearest first, equal ones by the number of their triangle. Longer lists are left to veil_merge.frag.
layout(early_fragment_tests) in;  // the stencil knows where there are any
layout(std140, binding = 2) uniform Lists {
  int width;   // of the picture
  uint slots;  // so many veils of a pixel have places of their own
  uint run;    // so many veils are sorted already
};
layout(std430, binding = 4) readonly buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) buffer Veils { uvec2 veil[]; };

// Depths are not negative, so their bits order them; nearer is greater.
bool isBefore(uvec2 a, uvec2 b) { return a.y > b.y || (a.y == b.y && (a.x & 0x7fffffffu) < (b.x & 0x7fffffffu)); }

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  for (uint k = min(slots, run); k < own.y; ++k) {
    uvec2 v = veil[own.x + k];
    uint begin = k - k % run, to = k;
    for (; to > begin && isBefore(v, veil[own.x + to - 1u]); --to) veil[own.x + to] = veil[own.x + to - 1u];
    veil[own.x + to] = v;
  }
}
