#version 450 core
// One light's share of the picture where something is seen through, as tinted_light.frag, without a stop among the tints.
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
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
layout(std430, binding = 2) readonly buffer Pixels { uvec2 pixel[]; };  // where its veils begin, and how many they are
layout(std430, binding = 3) readonly buffer Veils { uvec2 veil[]; };    // triangle, with bit 31 where it shows its front; bits of its depth
layout(std430, binding = 4) readonly buffer Sums { int sums[]; };            // four a veil, as tinted_volume_layers.frag has them
struct Material {
  vec4 colour;    // linear; opacity
  vec4 emission;  // linear
  vec4 passing;   // what of the light passes it
};
layout(std430, binding = 5) readonly buffer Materials { Material material[]; };
const uint kNone = 0xffffffffu, kId = 0x7fffffffu;
const float kSkyBase = 0.75;

layout(location = 0) out vec4 share;

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }

ivec4 sumAt(ivec2 at) {
  vec2 a = texelFetch(opaqueRed, at, 0).xy, b = texelFetch(greenBlue, at, 0).xy;
  vec2 c = texelFetch(lowRedGreen, at, 0).xy, d = texelFetch(lowBlue, at, 0).xy;
  return ivec4(int(a.x), (ivec3(int(a.y), int(b.x), int(b.y)) << 10) + ivec3(int(c.x), int(c.y), int(d.x)));
}

vec3 passingBy(ivec4 sum, ivec3 crossed) {
  return sum.x != 0 ? vec3(0.0) : clamp(exp2(-scale.x * vec3(sum.yzw + crossed)), 0.0, 1.0);
}

// A surface where the ray meets it.
struct Seen {
  vec3 normal;
  uint material, bits;
  float depth;  // along the view, for a ray whose component along it is 1
};

Seen seenAt(uint id, vec3 ray) {
  vec4 own = face[id].normal;
  vec3 a = (face[id].corner.xyz - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(own.xyz, ray);
  return Seen(own.xyz, floatBitsToUint(own.w), bitsOf(id), slope != 0.0 ? dot(own.xyz, a) / slope : 0.0);
}

bool isLit(Seen s, vec3 ray) {
  vec3 fromLight = ray * s.depth - lamp.xyz;
  return (s.bits & 1u) != 0u && (cone.w < -1.0 || dot(fromLight, cone.xyz) >= cone.w * length(fromLight));
}

bool liesUpon(Seen a, Seen b, vec3 ray) { return abs((b.depth - a.depth) * dot(ray, a.normal)) <= scale.y; }

// What the way from the eye takes up where it passes a veil: into its shadow where it shows the side that the light sees, else out of it.
ivec3 crossing(uint seen, Seen s) {
  uint side = s.bits >> 1 & 3u;
  int sense = (side == 1u ? 1 : side == 2u ? -1 : 0) * ((seen & ~kId) != 0u ? 1 : -1);
  return sense * face[seen & kId].filter3.xyz;
}

// What a surface sends to the eye. `reaching`: of the light.
vec3 sentBy(Seen s, vec3 reaching, vec3 ray) {
  vec3 n = dot(s.normal, ray) > 0.0 ? -s.normal : s.normal, towards = lamp.xyz - lamp.w * ray * s.depth;
  float ambient = isFirst != 0 ? sky.w * (kSkyBase + (1.0 - kSkyBase) * dot(n, sky.xyz)) : 0.0;
  Material m = material[s.material];
  return (isFirst != 0 ? m.emission.rgb : vec3(0.0)) + m.colour.rgb * (ambient + reaching * radiance.rgb * abs(dot(n, normalize(towards))));
}

// The background as the picture's codes have it.
vec3 linearBackground() {
  vec3 code = round(clamp(background.rgb, 0.0, 1.0) * 255.0) / 255.0;
  return mix(pow((code + 0.055) / 1.055, vec3(2.4)), code / 12.92, lessThanEqual(code, vec3(0.04045)));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  uvec2 own = pixel[at.y * width + at.x];
  uint lit = uint(litLayers);
  ivec4 sum = ivec4(atEyeOpaque, atEyeRed, atEyeGreen, atEyeBlue);
  // By the way from the eye, so far; and by those before that lie upon each other, which do not shadow each other.
  ivec3 crossed = ivec3(0), upon = ivec3(0);
  Seen before = Seen(vec3(0.0), 0u, 0u, -1e30);
  vec3 all = vec3(0.0), through = vec3(1.0), reaching = vec3(0.0);
  for (uint k = 0u; k < own.y; ++k) {
    uint i = own.x + k, seen = veil[i].x;
    Seen s = seenAt(seen & kId, ray);
    if (!liesUpon(before, s, ray)) upon = ivec3(0);
    if (lit == 0u) {
      reaching = isLit(s, ray) ? vec3(1.0) : vec3(0.0);
    } else if (k < lit) {
      sum += ivec4(sums[4u * i], sums[4u * i + 1u], sums[4u * i + 2u], sums[4u * i + 3u]);
      reaching = isLit(s, ray) ? passingBy(sum, crossed - upon) : vec3(0.0);
    }
    all += through * material[s.material].colour.a * sentBy(s, reaching, ray);
    through *= material[s.material].passing.rgb;
    ivec3 taken = crossing(seen, s);
    crossed += taken;
    upon += taken;
    before = s;
  }
  uint id = texelFetch(ids, at, 0).r;
  if (id == kNone) {
    if (isFirst != 0) all += through * linearBackground();
  } else {
    Seen s = seenAt(id, ray);
    if (!liesUpon(before, s, ray)) upon = ivec3(0);
    bool isDark = opaqueDark != 0 || !isLit(s, ray);
    reaching = isDark ? vec3(0.0) : passingBy(hasSums != 0 ? sumAt(at) : ivec4(0), crossed - upon);
    all += through * sentBy(s, reaching, ray);
  }
  share = vec4(all, isFirst);
}
