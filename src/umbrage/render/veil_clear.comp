#version 450 core
// No pixel has any veil.
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Counts { uint fragments, veils, most; };
layout(std430, binding = 4) writeonly buffer Pixels { uvec2 pixel[]; };
uint item() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

void main() {
  uint i = item();
  if (i == 0u) fragments = veils = most = 0u;
  if (i < uint(pixel.length())) pixel[i] = uvec2(0u);
}
