#version 450 core
// The same of triangles that reach far: their depth by the plane, as surface_large.frag has it.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
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
struct Large {
  vec4 plane;  // xyz . ray = 1 / depth, at most w; w < 0: take the interpolated depth
  uvec4 id;
};
layout(binding = 0) uniform sampler2D depths;
layout(std140, binding = 2) uniform Lists {
  int width;   // of the picture
  uint slots;  // so many veils of a pixel have places of their own
  uint run;    // so many veils are sorted already
};
layout(std430, binding = 1) readonly buffer LargeTriangles { Large large[]; };
layout(std430, binding = 2) buffer Counts { uint veils, spilled, most; };
layout(std430, binding = 3) writeonly buffer Slots { uvec2 slot[]; };  // as veil.frag
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };
layout(std430, binding = 6) writeonly buffer Spilled { uvec4 spill[]; };

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  vec4 plane = large[gl_PrimitiveID].plane;
  float depth = plane.w < 0.0 ? gl_FragCoord.z : toClip[3].z * clamp(dot(plane.xyz, ray), 0.0, plane.w);
  if (depth <= texelFetch(depths, at, 0).r) return;
  uint place = uint(at.y * width + at.x), k = atomicAdd(pixel[place].y, 1u);
  uvec2 seen = uvec2(large[gl_PrimitiveID].id.x | (gl_FrontFacing ? 0x80000000u : 0u), floatBitsToUint(depth));
  if (k < slots) {
    slot[slots * place + k] = seen;
    return;
  }
  uint s = atomicAdd(spilled, 1u);
  if (s < uint(spill.length())) spill[s] = uvec4(place, k, seen);
}
