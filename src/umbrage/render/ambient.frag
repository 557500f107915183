#version 450 core
// Light from everywhere, more of it from above (shadow::skyLight), and what surfaces give off by themselves.
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
struct Material {
  vec4 colour;    // linear; opacity
  vec4 emission;  // linear
  vec4 passing;   // what of the light passes it
};
layout(std430, binding = 4) readonly buffer Materials { Material material[]; };
const float kSkyBase = 0.75;

layout(location = 0) out vec4 share;

void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  if (id == kNone) discard;
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  vec3 n = triangle[id].xyz;
  if (dot(n, ray) > 0.0) n = -n;
  float ambient = sky.w * (kSkyBase + (1.0 - kSkyBase) * dot(n, sky.xyz));
  Material m = material[floatBitsToUint(triangle[id].w)];
  share = vec4(m.emission.rgb + m.colour.rgb * ambient, 1.0);
}
