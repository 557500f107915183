#version 450 core
// Only the stencil is written: where any veil faces the light.
layout(std140, binding = 0) uniform Tinted {
  vec4 eyeHigh;      // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 scale;        // one step of a filter; the distance below which surfaces count as one
  int litLayers;     // so many veils of each pixel are lit by themselves
  int hasVeils;
  int width;         // of the picture
  int pixelCount;    // tints of veils come after those of the opaque surfaces
  int light;         // which
  int hasSums;       // else nothing takes anything from the light but what the stencil counts
  int unused;
  int unused2;
  int atEyeOpaque;   // where the sums of veils start
  int atEyeRed;
  int atEyeGreen;
  int atEyeBlue;
};
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  for (uint k = 0u; k < own.y; ++k)
    if (facesLight(veil[own.x + k].x & 0x7fffffffu)) return;
  discard;
}
