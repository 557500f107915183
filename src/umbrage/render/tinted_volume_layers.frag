#version 450 core
// The same for two veils of each pixel at once, whose depths are compared here.
layout(std140, binding = 1) uniform Counted { ivec4 counted; };  // x: 0 before a surface, 1 behind it, 2 everywhere
layout(binding = 0) uniform sampler2D depths;
layout(location = 0) flat in vec4 high;
layout(location = 1) flat in vec3 low;
layout(location = 0) out vec2 opaqueRed;
layout(location = 1) out vec2 greenBlue;
layout(location = 2) out vec2 lowRedGreen;
layout(location = 3) out vec2 lowBlue;
layout(location = 4) out vec2 opaqueRed2;
layout(location = 5) out vec2 greenBlue2;
layout(location = 6) out vec2 lowRedGreen2;
layout(location = 7) out vec2 lowBlue2;

void main() {
  vec2 depth = texelFetch(depths, ivec2(gl_FragCoord.xy), 0).xy;
  vec2 before = vec2(greaterThan(vec2(gl_FragCoord.z), depth));
  vec2 counts = counted.x == 0 ? before : counted.x == 1 ? 1.0 - before : vec2(1.0);
  if (counts == vec2(0.0)) discard;
  vec2 sense = gl_FrontFacing ? counts : -counts;
  opaqueRed = sense.x * high.xy;
  greenBlue = sense.x * high.zw;
  lowRedGreen = sense.x * low.xy;
  lowBlue = vec2(sense.x * low.z, 0.0);
  opaqueRed2 = sense.y * high.xy;
  greenBlue2 = sense.y * high.zw;
  lowRedGreen2 = sense.y * low.xy;
  lowBlue2 = vec2(sense.y * low.z, 0.0);
}
