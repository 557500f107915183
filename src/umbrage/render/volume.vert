#version 450 core
// Shadow volumes by doubled vertices: 2i is position i, 2i + 1 is position i carried away from the light to infinity (w = 0).
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

invariant gl_Position;

void main() {
  vec3 p = positionOf(uint(gl_VertexID) >> 1);
  precise vec3 fromEye = (p - eyeHigh.xyz) - eyeLow.xyz;
  precise vec3 fromLight = lightHigh.w == 0.0 ? -lightHigh.xyz : (p - lightHigh.xyz) - lightLow.xyz;
  bool far = (gl_VertexID & 1) != 0;
  precise vec4 clip = toClip * (far ? vec4(fromLight, 0.0) : vec4(fromEye, 1.0));
  gl_Position = clip;
}
