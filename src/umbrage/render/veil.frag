#version 450 core
// The veils before the opaque surfaces, in any order: those that come first have places of their own, the others share a list. The depth test has left out what is hidden.
layout(early_fragment_tests) in;
layout(std140, binding = 2) uniform Lists {
  int width;   // of the picture
  uint slots;  // so many veils of a pixel have places of their own
  uint run;    // so many veils are sorted already
};
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 2) buffer Counts { uint veils, spilled, most; };
layout(std430, binding = 3) writeonly buffer Slots { uvec2 slot[]; };     // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };             // where its veils will begin, and how many they are
layout(std430, binding = 6) writeonly buffer Spilled { uvec4 spill[]; };  // pixel; which of its veils; as a slot

void main() {
  uint place = uint(int(gl_FragCoord.y) * width + int(gl_FragCoord.x)), k = atomicAdd(pixel[place].y, 1u);
  uvec2 seen = uvec2(ids[gl_PrimitiveID] | (gl_FrontFacing ? 0x80000000u : 0u), floatBitsToUint(gl_FragCoord.z));
  if (k < slots) {
    slot[slots * place + k] = seen;
    return;
  }
  uint s = atomicAdd(spilled, 1u);
  if (s < uint(spill.length())) spill[s] = uvec4(place, k, seen);
}
