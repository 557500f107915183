#version 450 core
// Sorts the veils of each pixel: the nearest first, equal ones by the number of their triangle.
layout(local_size_x = 64) in;
layout(std430, binding = 4) readonly buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) buffer Veils { uvec2 veil[]; };
uint item() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// Depths are not negative, so their bits order them; nearer is greater.
bool isBefore(uvec2 a, uvec2 b) { return a.y > b.y || (a.y == b.y && (a.x & 0x7fffffffu) < (b.x & 0x7fffffffu)); }

void main() {
  uint i = item();
  if (i >= uint(pixel.length())) return;
  uint first = pixel[i].x, count = pixel[i].y;
  for (uint k = 1u; k < count; ++k) {
    uvec2 v = veil[first + k];
    uint to = k;
    for (; to > 0u && isBefore(v, veil[first + to - 1u]); --to) veil[first + to] = veil[first + to - 1u];
    veil[first + to] = v;
  }
}
