#version 450 core
// A caster's corner, carried along the light's ray into a plane. Homogeneous, so that it may go to infinity; the parts of casters that cast no shadow
// there, below the plane and beyond the light, are clipped off before.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std140, binding = 1) uniform Plane {
  vec4 plane;         // its normal towards the light, and its distance, relative to the eye
  vec4 light;         // homogeneous, relative to the eye, its largest component about 1
  float lightHeight;  // plane . light, above 0
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[2];
};

void main() {
  vec3 p = (positionOf(uint(gl_VertexID)) - eyeHigh.xyz) - eyeLow.xyz;
  float height = dot(plane.xyz, p) + plane.w;
  vec4 onPlane = vec4(lightHeight * p - height * light.xyz, lightHeight - height * light.w);
  gl_ClipDistance[0] = height;
  gl_ClipDistance[1] = onPlane.w;
  gl_Position = toClip * onPlane;
}
