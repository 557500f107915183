#version 450 core
// One light's share of the picture, added to the others: colour x intensity x cosine, flat, two-sided.
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
const uint kNone = 0xffffffffu;
layout(std430, binding = 1) readonly buffer Triangles { vec4 triangle[]; };  // unit normal; material as the bits of w
layout(std430, binding = 2) readonly buffer Corners { uint corner[]; };
layout(std430, binding = 3) readonly buffer Facing { uint facing[]; };  // one bit a triangle: the visible side faces the light

bool facesLight(uint id) { return (facing[id >> 5] >> (id & 31u) & 1u) != 0u; }

bool insideCone(vec3 fromLight) { return cone.w < -1.0 || dot(fromLight, cone.xyz) >= cone.w * length(fromLight); }

// Where the ray meets the plane of the triangle: exact to rounding at any distance, which a depth buffer is not.
vec3 seenPoint(uint id, vec3 ray) {
  vec3 a = (positionOf(corner[3u * id]) - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(triangle[id].xyz, ray);
  return slope != 0.0 ? ray * (dot(triangle[id].xyz, a) / slope) : a;
}

struct Material {
  vec4 colour;    // linear; opacity
  vec4 emission;  // linear
  vec4 passing;   // what of the light passes it
};
layout(std430, binding = 4) readonly buffer Materials { Material material[]; };

layout(location = 0) out vec4 share;

void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  if (id == kNone || !facesLight(id)) discard;
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  vec3 towards = light.xyz - light.w * seenPoint(id, ray);
  if (!insideCone(-towards)) discard;
  float cosine = abs(dot(triangle[id].xyz, normalize(towards)));
  share = vec4(material[floatBitsToUint(triangle[id].w)].colour.rgb * radiance.rgb * cosine, 1.0);
}
