#version 450 core
// What of the light reaches the opaque surfaces that are seen through veils. Nothing is drawn; tints are written.
layout(early_fragment_tests) in;  // the stencil decides before anything is written
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
  vec4 radiance;    // linear colour x intensity
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 0) uniform usampler2D ids;
// What lies between the opaque surface and the light, in parts as tinted_volume.frag has them.
layout(binding = 1) uniform sampler2D opaqueRed;
layout(binding = 2) uniform sampler2D greenBlue;
layout(binding = 3) uniform sampler2D lowRedGreen;
layout(binding = 4) uniform sampler2D lowBlue;
struct Face {
  vec4 normal;   // unit; material as the bits of w
  vec4 corner;   // one of its corners
  ivec4 filter3;  // what a veil takes, in steps; w: 1 for a veil
};
layout(std430, binding = 0) readonly buffer Faces { Face face[]; };
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) writeonly buffer Tints { uvec2 tints[]; };  // 16 bits a channel
const uint kNone = 0xffffffffu, kId = 0x7fffffffu;

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

// Along the view, for a ray whose component along it is 1.
float depthOf(uint id, vec3 ray) {
  vec3 a = (face[id].corner.xyz - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(face[id].normal.xyz, ray);
  return slope != 0.0 ? dot(face[id].normal.xyz, a) / slope : 0.0;
}

bool isLit(uint id, vec3 ray) {
  bool is = facesLight(id);
  // A loop, since rasterisers on the processor work out both sides of a condition, but no loop that nobody enters.
  for (float cosine = cone.w; is && cosine >= -1.0; cosine = -2.0) {
    vec3 fromLight = ray * depthOf(id, ray) - lamp.xyz;
    is = dot(fromLight, cone.xyz) >= cosine * length(fromLight);
  }
  return is;
}

// What the way from the eye takes up where it passes a veil: into its shadow where it shows the side that the light sees, else out of it.
ivec3 crossing(uint seen) {
  uint id = seen & kId, side = bitsOf(id) >> 1 & 3u;
  int sense = (side == 1u ? 1 : side == 2u ? -1 : 0) * ((seen & ~kId) != 0u ? 1 : -1);
  return sense * face[id].filter3.xyz;
}

bool liesUpon(uint a, uint b, vec3 ray) {
  return abs((depthOf(b, ray) - depthOf(a, ray)) * dot(ray, face[a].normal.xyz)) <= scale.y;
}

ivec4 sumAt(ivec2 at) {
  vec2 a = texelFetch(opaqueRed, at, 0).xy, b = texelFetch(greenBlue, at, 0).xy;
  vec2 c = texelFetch(lowRedGreen, at, 0).xy, d = texelFetch(lowBlue, at, 0).xy;
  return ivec4(int(a.x), (ivec3(int(a.y), int(b.x), int(b.y)) << 10) + ivec3(int(c.x), int(c.y), int(d.x)));
}

// Of a surface behind the first `before` veils, which took `crossed`.
uvec2 reaching(uint id, ivec4 sum, uvec2 own, uint before, ivec3 crossed, vec3 ray) {
  if (sum.x != 0) return uvec2(0u);
  // Surfaces upon each other do not shadow each other.
  for (uint k = before; k > 0u && liesUpon(veil[own.x + k - 1u].x & kId, id, ray); --k) crossed -= crossing(veil[own.x + k - 1u].x);
  vec3 passing = clamp(exp2(-scale.x * vec3(sum.yzw + crossed)), 0.0, 1.0);
  uvec3 code = uvec3(passing * 65535.0 + 0.5);
  return uvec2(code.r | code.g << 16, code.b);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uint id = texelFetch(ids, at, 0).r;
  if (id == kNone || !isLit(id, ray)) return;
  int place = at.y * width + at.x;
  uvec2 own = hasVeils != 0 ? pixel[place] : uvec2(0u);
  ivec3 crossed = ivec3(0);
  for (uint k = 0u; k < own.y; ++k) crossed += crossing(veil[own.x + k].x);
  tints[place] = reaching(id, hasSums != 0 ? sumAt(at) : ivec4(0), own, own.y, crossed, ray);
}
