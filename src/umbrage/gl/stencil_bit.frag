#version 450 core
// Leaves out the pixels whose value lacks one bit; what is left, with all samples of a pixel, sets that bit of the stencil.
layout(std430, binding = 0) readonly buffer Values { uint values[]; };  // a byte a pixel, row by row from the bottom
layout(std140, binding = 0) uniform Parameters {
  ivec4 where;  // lower left corner, width, and the bit's number
};

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - where.xy;
  uint at = uint(pixel.y * where.z + pixel.x);
  uint value = values[at >> 2] >> ((at & 3u) * 8u);
  if (((value >> where.w) & 1u) == 0u) discard;
}
