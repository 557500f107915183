#version 450 core
// Puts every fragment among the veils of its pixel.
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Counts { uint fragments, veils, most; };
layout(std430, binding = 3) readonly buffer Fragments { uvec4 fragment[]; };
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) writeonly buffer Veils { uvec2 veil[]; };
uint item() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

void main() {
  uint i = item();
  if (i >= fragments) return;
  uvec4 f = fragment[i];
  veil[pixel[f.x].x + atomicAdd(pixel[f.x].y, 1u)] = f.yz;
}
