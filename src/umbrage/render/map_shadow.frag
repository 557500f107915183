#version 450 core
// What a shadow map takes from a light's mask: drawn over it as black, as opaque as the part of the texels that lie before the surface.
// The surface is compared where its own plane passes the middle of each texel, so that it does not shade itself however steep it is.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }
layout(std140, binding = 1) uniform Shading {
  vec4 rayCorner;   // the ray through window coordinates (x, y): rayCorner + x * rayX + y * rayY, relative to the eye
  vec4 rayX;
  vec4 rayY;
  vec4 light;       // relative to the eye; w = 0: the direction towards it
  vec4 radiance;    // linear colour x intensity
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D map;
const uint kNone = 0xffffffffu;
layout(std430, binding = 1) readonly buffer Triangles { vec4 triangle[]; };  // unit normal; material as the bits of w
layout(std430, binding = 2) readonly buffer Corners { uint corner[]; };
layout(std430, binding = 3) readonly buffer Facing { uint facing[]; };  // one bit a triangle: the visible side faces the light

bool facesLight(uint id) { return (facing[id >> 5] >> (id & 31u) & 1u) != 0u; }

// Where the ray meets the plane of the triangle: exact to rounding at any distance, which a depth buffer is not.
vec3 seenPoint(uint id, vec3 ray) {
  vec3 a = (positionOf(corner[3u * id]) - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(triangle[id].xyz, ray);
  return slope != 0.0 ? ray * (dot(triangle[id].xyz, a) / slope) : a;
}

layout(std140, binding = 2) uniform Map {
  mat4 toMap;       // from (position - eye, 1) to the map's clip coordinates; greater depth is nearer to the light
  mat4 planeToMap;  // the same for planes
  vec4 drawn;       // the half-space outside of which casters are cut off
  float texels;     // a side
  float inside;     // what of -1..1 is looked up
  float constantBias;
  float slopeBias;
  int radius;       // texels around the nearest that are compared too
};

layout(location = 0) out vec4 black;

float shadowAt(ivec2 texel, vec2 from, float depth, vec2 slope, float bias) {
  float surface = max(depth + dot(slope, vec2(texel) + 0.5 - from), 0.0);
  return texelFetch(map, clamp(texel, ivec2(0), ivec2(int(texels) - 1)), 0).r > surface + bias ? 1.0 : 0.0;
}

// The mean over a square of 2 radius + 1 texels around a point, those at its border by what of them lies inside.
float filtered(vec2 at, float depth, vec2 slope, float bias) {
  vec2 corner = at - 0.5;
  ivec2 first = ivec2(floor(corner));
  vec2 part = corner - vec2(first);
  float sum = 0.0;
  for (int j = -radius; j <= radius + 1; ++j)
    for (int i = -radius; i <= radius + 1; ++i) {
      vec2 weight = vec2(i == -radius ? 1.0 - part.x : i == radius + 1 ? part.x : 1.0,
                         j == -radius ? 1.0 - part.y : j == radius + 1 ? part.y : 1.0);
      sum += weight.x * weight.y * shadowAt(first + ivec2(i, j), at, depth, slope, bias);
    }
  float width = float(2 * radius + 1);
  return sum / (width * width);
}

void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  if (id == kNone || !facesLight(id)) discard;
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  vec4 p = vec4(seenPoint(id, ray), 1.0);
  vec4 clip = toMap * p;
  if (dot(drawn, p) <= 0.0 || clip.w <= 0.0 || any(greaterThan(abs(clip.xy), vec2(inside * clip.w)))) discard;
  vec3 where = clip.xyz / clip.w;
  vec2 at = (0.5 + 0.5 * where.xy) * texels;
  vec3 corner0 = (positionOf(corner[3u * id]) - eyeHigh.xyz) - eyeLow.xyz;
  vec4 plane = planeToMap * vec4(triangle[id].xyz, -dot(triangle[id].xyz, corner0));
  vec2 slope = plane.z != 0.0 ? -plane.xy / plane.z * (2.0 / texels) : vec2(0.0);
  float bias = constantBias + slopeBias * (abs(slope.x) + abs(slope.y));
  float shadow = radius == 0 ? shadowAt(ivec2(floor(at)), at, where.z, slope, bias) : filtered(at, where.z, slope, bias);
  if (shadow == 0.0) discard;
  black = vec4(0.0, 0.0, 0.0, shadow);
}
