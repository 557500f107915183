#version 450 core
// The veils before the opaque surfaces, in any order: a list of all fragments, and how many each pixel has.
layout(binding = 0) uniform sampler2D depths;
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 2) buffer Counts { uint fragments, veils, most; };
layout(std430, binding = 3) writeonly buffer Fragments { uvec4 fragment[]; };  // pixel; triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (gl_FragCoord.z <= texelFetch(depths, at, 0).r) return;
  uint place = uint(at.y * textureSize(depths, 0).x + at.x), k = atomicAdd(fragments, 1u);
  atomicAdd(pixel[place].y, 1u);
  if (k < uint(fragment.length()))
    fragment[k] = uvec4(place, ids[gl_PrimitiveID] | (gl_FrontFacing ? 0x80000000u : 0u), floatBitsToUint(gl_FragCoord.z), 0u);
}
