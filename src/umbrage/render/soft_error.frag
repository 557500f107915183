#version 450 core
// Per tile of 16 x 16 pixels: how far the halves of the samples are apart, as a sum of squares, and of how many surfaces.
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
layout(std430, binding = 5) readonly buffer Halves { vec4 halves[]; };  // of both halves of the samples, per surface: the sum of their light, and of their weights
const uint kNone = 0xffffffffu;
const int kTile = 16;

layout(location = 0) out vec2 squaresAndCount;

float squareAt(uint place) {
  vec4 a = halves[place], b = halves[uint(surfaces) + place];
  float apart = dot(a.rgb / a.w - b.rgb / b.w, vec3(0.2126, 0.7152, 0.0722)) / 2.0;
  return min(a.w, b.w) > 0.0 ? apart * apart : 0.0;
}

void main() {
  ivec2 size = textureSize(ids, 0), corner = ivec2(gl_FragCoord.xy) * kTile, end = min(corner + kTile, size);
  vec2 sum = vec2(0.0);
  for (int y = corner.y; y < end.y; ++y)
    for (int x = corner.x; x < end.x; ++x) {
      uint place = uint(y * size.x + x);
      if (texelFetch(ids, ivec2(x, y), 0).r != kNone) sum += vec2(squareAt(place), 1.0);
      uvec2 own = hasVeils != 0 ? pixel[place] : uvec2(0u);
      for (uint k = own.x; k < own.x + own.y; ++k)
        sum += vec2(squareAt(uint(pixelCount) + k), 1.0);
    }
  squaresAndCount = sum;
}
