#version 450 core
// Shadow volumes all of whose vertices were computed on the processor.
layout(std140, binding = 0) uniform View {
  mat4 toClip;  // from (position - eye, w)
};
layout(std430, binding = 0) readonly buffer Points { vec4 point[]; };  // relative to the eye

invariant gl_Position;

void main() {
  precise vec4 clip = toClip * point[gl_VertexID];
  gl_Position = clip;
}
