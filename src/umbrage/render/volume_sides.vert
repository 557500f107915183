#version 450 core
// The ends of an edge for volume_sides.geom: 2i is position i, with itself carried away from the light to infinity (w = 0).
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
out Corner { vec4 far; } corner;

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

invariant gl_Position;

void main() {
  vec3 p = positionOf(uint(gl_VertexID) >> 1);
  precise vec3 fromEye = (p - eyeHigh.xyz) - eyeLow.xyz;
  precise vec3 fromLight = lightHigh.w == 0.0 ? -lightHigh.xyz : (p - lightHigh.xyz) - lightLow.xyz;
  precise vec4 clip = toClip * vec4(fromEye, 1.0);
  precise vec4 far = toClip * vec4(fromLight, 0.0);
  gl_Position = clip;
  corner.far = far;
}
