#version 450 core
// One light's share of the picture where nothing is seen through, without a stop among the tints. The stencil has only those surfaces left that face the light.
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
struct Material {
  vec4 colour;    // linear; opacity
  vec4 emission;  // linear
  vec4 passing;   // what of the light passes it
};
layout(std430, binding = 5) readonly buffer Materials { Material material[]; };
const float kSkyBase = 0.75;

layout(location = 0) out vec4 share;

ivec4 sumAt(ivec2 at) {
  vec2 a = texelFetch(opaqueRed, at, 0).xy, b = texelFetch(greenBlue, at, 0).xy;
  vec2 c = texelFetch(lowRedGreen, at, 0).xy, d = texelFetch(lowBlue, at, 0).xy;
  return ivec4(int(a.x), (ivec3(int(a.y), int(b.x), int(b.y)) << 10) + ivec3(int(c.x), int(c.y), int(d.x)));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uint id = texelFetch(ids, at, 0).r;
  vec4 own = face[id].normal;
  vec3 a = (face[id].corner.xyz - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(own.xyz, ray);
  vec3 towards = lamp.xyz - lamp.w * (slope != 0.0 ? ray * (dot(own.xyz, a) / slope) : a);
  bool isLit = cone.w < -1.0 || dot(-towards, cone.xyz) >= cone.w * length(towards);
  ivec4 sum = hasSums != 0 ? sumAt(at) : ivec4(0);
  vec3 passing = sum.x != 0 || !isLit ? vec3(0.0) : clamp(exp2(-scale.x * vec3(sum.yzw)), 0.0, 1.0);
  vec3 light = passing * radiance.rgb * abs(dot(own.xyz, normalize(towards)));
  if (isFirst != 0) light += sky.w * (kSkyBase + (1.0 - kSkyBase) * dot(slope > 0.0 ? -own.xyz : own.xyz, sky.xyz));
  Material m = material[floatBitsToUint(own.w)];
  share = vec4(m.colour.rgb * light + (isFirst != 0 ? m.emission.rgb : vec3(0.0)), isFirst);
}
