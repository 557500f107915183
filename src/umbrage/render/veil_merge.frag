#version 450 core
// Merges every two neighbouring runs of `run` sorted veils of each pixel. Its loop is passed once a veil: drivers that draw on the processor leave a shader after 65,535 rounds of all
// its loops together, and sorting 362 veils by insertion takes more.
layout(early_fragment_tests) in;  // the stencil knows where there are any
layout(std140, binding = 2) uniform Lists {
  int width;   // of the picture
  uint slots;  // so many veils of a pixel have places of their own
  uint run;    // so many veils are sorted already
};
layout(std430, binding = 3) writeonly buffer Merged { uvec2 merged[]; };
layout(std430, binding = 4) readonly buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) readonly buffer Veils { uvec2 veil[]; };

// Depths are not negative, so their bits order them; nearer is greater.
bool isBefore(uvec2 a, uvec2 b) { return a.y > b.y || (a.y == b.y && (a.x & 0x7fffffffu) < (b.x & 0x7fffffffu)); }

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  uint a = 0u, b = 0u, endA = 0u, endB = 0u, last = max(own.y, 1u) - 1u;
  for (uint k = 0u; k < own.y; ++k) {
    if (a == endA && b == endB) {
      a = k;
      b = endA = min(own.y, k + run);
      endB = min(own.y, b + run);
    }
    uvec2 left = veil[own.x + min(a, last)], right = veil[own.x + min(b, last)];
    bool takesLeft = b == endB || (a < endA && isBefore(left, right));
    merged[own.x + k] = takesLeft ? left : right;
    if (takesLeft)
      ++a;
    else
      ++b;
  }
}
