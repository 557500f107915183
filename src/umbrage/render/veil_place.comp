#version 450 core
// Puts the veils that had no places of their own among those of their pixels.
layout(local_size_x = 64) in;
layout(std430, binding = 2) readonly buffer Counts { uint veils, spilled, most; };
layout(std430, binding = 4) readonly buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 5) writeonly buffer Veils { uvec2 veil[]; };
layout(std430, binding = 6) readonly buffer Spilled { uvec4 spill[]; };
uint item() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

void main() {
  uint i = item();
  if (i >= spilled) return;
  uvec4 s = spill[i];
  veil[pixel[s.x].x + s.y] = s.zw;
}
