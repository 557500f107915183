#version 450 core
// As receiver_tiles.frag, with the veils that are lit by themselves among the receivers.
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
  int isFirst;       // light of the picture, which adds the ambient light, too
  int opaqueDark;    // of pixels with veils: nothing reaches the opaque surface
  int atEyeOpaque;   // where the sums of veils start
  int atEyeRed;
  int atEyeGreen;
  int atEyeBlue;
};
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D depths;
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
const uint kNone = 0xffffffffu;
const int kTile = 16;

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

layout(location = 0) out vec2 farthestNearest;

void main() {
  ivec2 size = textureSize(ids, 0), corner = ivec2(gl_FragCoord.xy) * kTile, end = min(corner + kTile, size);
  vec2 range = vec2(2.0, -1.0);
  for (int y = corner.y; y < end.y; ++y)
    for (int x = corner.x; x < end.x; ++x) {
      uint id = texelFetch(ids, ivec2(x, y), 0).r;
      if (id != kNone && facesLight(id)) {
        float depth = texelFetch(depths, ivec2(x, y), 0).r;
        range = vec2(min(range.x, depth), max(range.y, depth));
      }
      uvec2 own = hasVeils != 0 ? pixel[y * size.x + x] : uvec2(0u);
      for (uint k = 0u; k < min(own.y, uint(litLayers)); ++k) {
        uvec2 v = veil[own.x + k];
        if (!facesLight(v.x & 0x7fffffffu)) continue;
        float depth = uintBitsToFloat(v.y);
        range = vec2(min(range.x, depth), max(range.y, depth));
      }
    }
  farthestNearest = range;
}
