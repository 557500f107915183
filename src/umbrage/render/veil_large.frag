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
layout(std430, binding = 1) readonly buffer LargeTriangles { Large large[]; };
layout(std430, binding = 2) buffer Counts { uint fragments, veils, most; };
layout(std430, binding = 3) writeonly buffer Fragments { uvec4 fragment[]; };  // as veil.frag
layout(std430, binding = 4) buffer Pixels { uvec2 pixel[]; };

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  vec4 plane = large[gl_PrimitiveID].plane;
  float depth = plane.w < 0.0 ? gl_FragCoord.z : toClip[3].z * clamp(dot(plane.xyz, ray), 0.0, plane.w);
  if (depth <= texelFetch(depths, at, 0).r) return;
  uint place = uint(at.y * textureSize(depths, 0).x + at.x), k = atomicAdd(fragments, 1u);
  atomicAdd(pixel[place].y, 1u);
  if (k < uint(fragment.length()))
    fragment[k] = uvec4(place, large[gl_PrimitiveID].id.x | (gl_FrontFacing ? 0x80000000u : 0u), floatBitsToUint(depth), 0u);
}
