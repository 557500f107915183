#version 450 core
// As depth: the farthest veil of a pixel that is lit by itself; nothing is before it where there is none.
layout(std140, binding = 0) uniform Tinted {
  vec4 eyeHigh;      // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 scale;        // one step of a filter; the distance below which surfaces count as one
  int litLayers;     // so many veils of each pixel are lit by themselves
  int hasVeils;
  int width;         // of the picture
};
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  uint count = min(own.y, uint(litLayers));
  gl_FragDepth = count > 0u ? uintBitsToFloat(veil[own.x + count - 1u].y) : 1.0;
}
