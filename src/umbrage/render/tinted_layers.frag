#version 450 core
// The depths of two veils of each pixel, 2 (before everything) where there is none; nothing where neither of them faces the light.
layout(std140, binding = 0) uniform Tinted {
  vec4 eyeHigh;      // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 scale;        // one step of a filter; the distance below which surfaces count as one
  int firstLayer;    // of the two that are asked about; -1: the opaque surface is; -2: nothing is, and it is dark
  int litLayers;     // so many veils of each pixel are lit by themselves
  int hasVeils;
  int width;         // of the picture
  int pixelCount;    // tints of veils come after those of the opaque surfaces
  int light;         // which
  int hasSums;       // else nothing takes anything from the light but what the stencil counts
};
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

layout(location = 0) out vec2 depths;

void main() {
  uvec2 own = pixel[int(gl_FragCoord.y) * width + int(gl_FragCoord.x)];
  uint count = min(own.y, uint(litLayers));
  bool faces = false;
  depths = vec2(2.0);
  for (uint i = 0u; i < 2u; ++i) {
    uint k = uint(firstLayer) + i;
    if (k >= count) break;
    uvec2 v = veil[own.x + k];
    if (!facesLight(v.x & 0x7fffffffu)) continue;
    faces = true;
    depths[i] = uintBitsToFloat(v.y);
  }
  if (!faces) discard;
}
