#version 450 core
// Leaves the pixels whose plane's number has a bit, which is then set in the stencil.
layout(binding = 0) uniform usampler2D ids;
const uint kNone = 0xffffffffu;
layout(std430, binding = 1) readonly buffer Planes { uint planes[]; };  // a byte a triangle: 1 + its plane, or 0
layout(std140, binding = 1) uniform Bit { uint bit; };

void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  if (id == kNone) discard;
  uint plane = planes[id >> 2] >> ((id & 3u) * 8u);
  if ((plane >> bit & 1u) == 0u) discard;
}
