#version 450 core
// Lets through the pixels whose code has one bit set.
layout(std140, binding = 0) uniform Place { ivec4 place; };  // x, y of the viewport's corner; its width; the bit
layout(std430, binding = 0) readonly buffer Codes { uint codes[]; };  // four pixels a word, row by row from the bottom
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy) - place.xy;
  int pixel = at.y * place.z + at.x;
  uint code = codes[pixel >> 2] >> ((pixel & 3) * 8);
  if ((code & uint(place.w)) == 0u) discard;
}
