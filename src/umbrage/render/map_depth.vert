#version 450 core
// A caster's corner in a shadow map.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }
layout(std140, binding = 2) uniform Map {
  mat4 toMap;       // from (position - eye, 1) to the map's clip coordinates; greater depth is nearer to the light
  mat4 planeToMap;  // the same for planes
  vec4 drawn;       // the half-space outside of which casters are cut off
  float texels;     // a side
  float inside;     // what of -1..1 is looked up
  float constantBias;
  float slopeBias;
  int radius;       // texels around the nearest that are compared too
};

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[1];
};

void main() {
  vec4 p = vec4((positionOf(uint(gl_VertexID)) - eyeHigh.xyz) - eyeLow.xyz, 1.0);
  gl_ClipDistance[0] = dot(drawn, p);
  gl_Position = toMap * p;
}
