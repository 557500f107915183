#version 450 core
// As encode.frag, with the veils over what lies behind them, the farthest first.
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
layout(std140, binding = 1) uniform Shading {
  vec4 rayCorner;   // the ray through window coordinates (x, y): rayCorner + x * rayX + y * rayY, relative to the eye
  vec4 rayX;
  vec4 rayY;
  vec4 lamp;        // relative to the eye; w = 0: the direction towards it
  vec4 radiance;    // here: the background, linear
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D sum;
struct Face {
  vec4 normal;   // unit; material as the bits of w
  vec4 corner;   // one of its corners
  ivec4 filter3;  // what a veil takes, in steps; w: 1 for a veil
};
layout(std430, binding = 0) readonly buffer Faces { Face face[]; };
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 5) readonly buffer Materials { vec4 material[]; };    // linear colour, opacity
layout(std430, binding = 6) readonly buffer VeilLight { vec4 veilLight[]; };
layout(std430, binding = 7) readonly buffer Passing { vec4 passing[]; };       // per material: what of the light passes it
const uint kNone = 0xffffffffu, kId = 0x7fffffffu;
const float kSkyBase = 0.75;

layout(location = 0) out vec4 colour;

vec3 srgbOf(vec3 linear) { return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308))); }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uvec2 own = hasVeils != 0 ? pixel[at.y * width + at.x] : uvec2(0u);
  bool isSky = texelFetch(ids, at, 0).r == kNone;
  if (isSky && own.y == 0u) {
    colour = vec4(background.rgb, 1.0);
    return;
  }
  vec3 behind = isSky ? radiance.rgb : texelFetch(sum, at, 0).rgb;
  for (uint k = own.y; k > 0u; --k) {
    uint id = veil[own.x + k - 1u].x & kId, m = floatBitsToUint(face[id].normal.w);
    vec3 n = face[id].normal.xyz;
    if (dot(n, ray) > 0.0) n = -n;
    vec3 lit = material[m].rgb * sky.w * (kSkyBase + (1.0 - kSkyBase) * dot(n, sky.xyz));
    if (light > 0) lit += veilLight[own.x + k - 1u].rgb;  // of so many lights
    behind = passing[m].rgb * behind + material[m].a * lit;
  }
  colour = vec4(srgbOf(clamp(behind, 0.0, 1.0)), 1.0);
}
