#version 450 core
// Adds one sample's light, on every surface that a pixel shows, to a half of the samples. Nothing is drawn.
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
layout(std140, binding = 1) uniform Shading {
  vec4 rayCorner;   // the ray through window coordinates (x, y): rayCorner + x * rayX + y * rayY, relative to the eye
  vec4 rayX;
  vec4 rayY;
  vec4 lamp;        // relative to the eye; w = 0: the direction towards it
  vec4 radiance;    // linear colour x intensity
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 0) uniform usampler2D ids;
struct Face {
  vec4 normal;   // unit; material as the bits of w
  vec4 corner;   // one of its corners
  ivec4 filter3;  // what a veil takes, in steps; w: 1 for a veil
};
layout(std430, binding = 0) readonly buffer Faces { Face face[]; };
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) readonly buffer Tints { uvec2 tints[]; };  // 16 bits a channel
layout(std430, binding = 5) buffer Halves { vec4 halves[]; };  // of both halves of the samples, per surface: the sum of their light, and of their weights
const uint kNone = 0xffffffffu, kId = 0x7fffffffu;

// As shadow::LightSample::weight.
float weightAt(uint id, vec3 ray) {
  if (ball.w < 0.0) return 1.0;
  vec3 a = (face[id].corner.xyz - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(face[id].normal.xyz, ray);
  vec3 point = slope != 0.0 ? ray * (dot(face[id].normal.xyz, a) / slope) : a;
  vec3 toCentre = ball.xyz - point, toSample = ballSample.xyz - point;
  float distance2 = dot(toCentre, toCentre), along = dot(toCentre, toSample), radius2 = ball.w * ball.w;
  if (distance2 <= radius2) return 1.0;
  float passing = distance2 - along * along / dot(toSample, toSample);
  return min(4.0, distance2 / (distance2 + radius2 / 2.0 - 1.5 * min(max(0.0, passing), radius2)));
}

void add(uint place, uint id, vec3 ray) {
  uvec2 t = tints[place];
  float weight = weightAt(id, ray);
  vec4 sum = weight * vec4(vec3(t.x & 0xffffu, t.x >> 16, t.y) / 65535.0, 1.0);
  uint at = uint(half1 * surfaces) + place;
  halves[at] += sum;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uint place = uint(at.y * width + at.x), id = texelFetch(ids, at, 0).r;
  if (id != kNone) add(place, id, ray);
  uvec2 own = hasVeils != 0 ? pixel[place] : uvec2(0u);
  for (uint k = own.x; k < own.x + own.y; ++k) add(uint(pixelCount) + k, veil[k].x & kId, ray);
}
