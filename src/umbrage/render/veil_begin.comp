#version 450 core
// Where the veils of each pixel begin; the order of the pixels is left to chance. Their numbers start anew, for veil_place.comp.
layout(local_size_x = 64) in;
layout(std430, binding = 2) buffer Counts { uint fragments, veils, most; };
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };
uint item() { return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

void main() {
  uint i = item();
  if (i >= uint(pixel.length()) || pixel[i].y == 0u) return;
  atomicMax(most, pixel[i].y);
  pixel[i] = uvec2(atomicAdd(veils, pixel[i].y), 0u);
}
