#version 450 core
// The ends of an edge for volume_sides.geom: 2i is position i, with its far point, computed on the processor.
layout(std140, binding = 0) uniform View {
  mat4 toClip;   // from (position - eye, w)
  vec4 eyeHigh;  // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
layout(std430, binding = 1) readonly buffer FarPoints { vec4 farPoint[]; };  // relative to the eye
out Corner { vec4 far; } corner;

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

invariant gl_Position;

void main() {
  uint i = uint(gl_VertexID) >> 1;
  precise vec3 fromEye = (positionOf(i) - eyeHigh.xyz) - eyeLow.xyz;
  precise vec4 clip = toClip * vec4(fromEye, 1.0);
  precise vec4 far = toClip * farPoint[i];
  gl_Position = clip;
  corner.far = far;
}
