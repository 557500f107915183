#version 450 core
// As receiver_tiles.frag. What tinted_tiles_veiled.frag says where no veil is lit by itself.
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D depths;
layout(std430, binding = 1) readonly buffer LightBits { uint lightBits[]; };  // 4 bits a triangle: the visible side faces the light; lightSide is 1; is -1
const uint kNone = 0xffffffffu;
const int kTile = 16;

uint bitsOf(uint id) { return lightBits[id >> 3] >> (4u * (id & 7u)); }
bool facesLight(uint id) { return (bitsOf(id) & 1u) != 0u; }

layout(location = 0) out vec2 farthestNearest;

void main() {
  ivec2 size = textureSize(ids, 0), corner = ivec2(gl_FragCoord.xy) * kTile, end = min(corner + kTile, size);
  vec2 range = vec2(2.0, -1.0);
  for (int y = corner.y; y < end.y; ++y)
    for (int x = corner.x; x < end.x; ++x) {
      uint id = texelFetch(ids, ivec2(x, y), 0).r;
      if (id != kNone && facesLight(id)) {
        float depth = texelFetch(depths, ivec2(x, y), 0).r;
        range = vec2(min(range.x, depth), max(range.y, depth));
      }
    }
  farthestNearest = range;
}
