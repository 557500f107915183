#version 450 core
// What of the light all samples together let reach each surface. Nothing is drawn; tints are written.
layout(std140, binding = 0) uniform Soft {
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
  vec4 ball;         // centre, relative to the eye, and radius; below 0: all samples count alike
  vec4 ballSample;   // the point of it, relative to the eye
  int half1;         // of the samples, to which this one belongs
  int surfaces;      // of the picture: opaque ones and veils
};
layout(binding = 0) uniform usampler2D ids;
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) writeonly buffer Tints { uvec2 tints[]; };  // 16 bits a channel
layout(std430, binding = 5) readonly buffer Halves { vec4 halves[]; };  // of both halves of the samples, per surface: the sum of their light, and of their weights
const uint kNone = 0xffffffffu;

void write(uint place, bool both) {
  vec4 sum = halves[place];
  if (both) sum += halves[uint(surfaces) + place];
  uvec3 code = uvec3(clamp(sum.w > 0.0 ? sum.rgb / sum.w : vec3(0.0), 0.0, 1.0) * 65535.0 + 0.5);
  tints[place] = uvec2(code.r | code.g << 16, code.b);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  uint place = uint(at.y * width + at.x);
  if (texelFetch(ids, at, 0).r != kNone)
    write(place, half1 != 0);
  else
    tints[place] = uvec2(0u);
  uvec2 own = hasVeils != 0 ? pixel[place] : uvec2(0u);
  for (uint k = own.x; k < own.x + own.y; ++k) write(uint(pixelCount) + k, half1 != 0);
}
