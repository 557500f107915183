#version 450 core
// Only the stencil is written: where the opaque surface faces the light, so that volumes are summed up for nobody else.
layout(binding = 0) uniform usampler2D ids;
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
const uint kNone = 0xffffffffu;

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

void main() {
  uint id = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  if (id == kNone || !facesLight(id)) discard;
}
