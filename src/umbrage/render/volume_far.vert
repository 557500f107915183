#version 450 core
// Shadow volumes by doubled vertices whose ends were computed on the processor: 2i is position i, 2i + 1 is its far point.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
layout(std430, binding = 1) readonly buffer FarPoints { vec4 farPoint[]; };  // relative to the eye

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

invariant gl_Position;

void main() {
  uint i = uint(gl_VertexID) >> 1;
  precise vec3 fromEye = (positionOf(i) - eyeHigh.xyz) - eyeLow.xyz;
  precise vec4 clip = toClip * ((gl_VertexID & 1) != 0 ? farPoint[i] : vec4(fromEye, 1.0));
  gl_Position = clip;
}
