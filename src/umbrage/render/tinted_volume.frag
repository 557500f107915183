#version 450 core
// Adds what a piece of a volume adds, where the depth test says that it counts.
layout(location = 0) flat in vec4 high;
layout(location = 1) flat in vec3 low;
layout(location = 0) out vec2 opaqueRed;
layout(location = 1) out vec2 greenBlue;
layout(location = 2) out vec2 lowRedGreen;
layout(location = 3) out vec2 lowBlue;

void main() {
  float sense = gl_FrontFacing ? 1.0 : -1.0;
  opaqueRed = sense * high.xy;
  greenBlue = sense * high.zw;
  lowRedGreen = sense * low.xy;
  lowBlue = vec2(sense * low.z, 0.0);
}
