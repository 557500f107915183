#version 450 core
// What the camera sees. Shares its arithmetic with volume.vert, so that a near cap lies exactly on its surface.
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
  precise vec3 fromEye = (positionOf(uint(gl_VertexID)) - eyeHigh.xyz) - eyeLow.xyz;
  precise vec4 clip = toClip * vec4(fromEye, 1.0);
  gl_Position = clip;
}
