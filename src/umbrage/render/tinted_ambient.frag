#version 450 core
// As ambient.frag, of veils and of what is seen through them; the background among it.
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
struct Face {
  vec4 normal;   // unit; material as the bits of w
  vec4 corner;   // one of its corners
  ivec4 filter3;  // what a veil takes, in steps; w: 1 for a veil
};
layout(std430, binding = 0) readonly buffer Faces { Face face[]; };
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
struct Material {
  vec4 colour;    // linear; opacity
  vec4 emission;  // linear
  vec4 passing;   // what of the light passes it
};
layout(std430, binding = 5) readonly buffer Materials { Material material[]; };
const uint kNone = 0xffffffffu, kId = 0x7fffffffu;
const float kSkyBase = 0.75;

layout(location = 0) out vec4 share;

vec3 ambient(uint id, vec3 ray) {
  vec3 n = face[id].normal.xyz;
  if (dot(n, ray) > 0.0) n = -n;
  Material m = material[floatBitsToUint(face[id].normal.w)];
  return m.emission.rgb + m.colour.rgb * sky.w * (kSkyBase + (1.0 - kSkyBase) * dot(n, sky.xyz));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uvec2 own = pixel[at.y * width + at.x];
  vec3 sum = vec3(0.0), through = vec3(1.0);
  for (uint k = own.x; k < own.x + own.y; ++k) {
    uint seen = veil[k].x & kId, m = floatBitsToUint(face[seen].normal.w);
    sum += through * material[m].colour.a * ambient(seen, ray);
    through *= material[m].passing.rgb;
  }
  uint id = texelFetch(ids, at, 0).r;
  share = vec4(sum + through * (id != kNone ? ambient(id, ray) : radiance.rgb), 1.0);
}
