#version 450 core
// Per tile of 16 x 16 pixels: the depth of the farthest and of the nearest surface whose visible side faces the light. Nearer is
// greater; a tile without any gives (2, -1), which no surface is behind or before.
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D depths;
layout(std430, binding = 3) readonly buffer Facing { uint facing[]; };  // one bit a triangle: the visible side faces the light
const uint kNone = 0xffffffffu;
const int kTile = 16;

bool facesLight(uint id) { return (facing[id >> 5] >> (id & 31u) & 1u) != 0u; }

layout(location = 0) out vec2 farthestNearest;

void main() {
  ivec2 size = textureSize(ids, 0), corner = ivec2(gl_FragCoord.xy) * kTile, end = min(corner + kTile, size);
  vec2 range = vec2(2.0, -1.0);
  for (int y = corner.y; y < end.y; ++y)
    for (int x = corner.x; x < end.x; ++x) {
      uint id = texelFetch(ids, ivec2(x, y), 0).r;
      if (id == kNone || !facesLight(id)) continue;
      float depth = texelFetch(depths, ivec2(x, y), 0).r;
      range = vec2(min(range.x, depth), max(range.y, depth));
    }
  farthestNearest = range;
}
