#version 450 core
// Pieces of shadow volumes, four corners each, with what they add. Shares its arithmetic with surface.vert, so that a near cap lies exactly on its surface.
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
layout(std430, binding = 1) readonly buffer FarPoints { vec4 farPoint[]; };  // relative to the eye
struct Piece {
  uvec4 corners;  // into doubled vertices: 2i is position i, 2i + 1 is its far point
  ivec4 weight;   // opaque surfaces; what veils take of red, green and blue
};
layout(std430, binding = 2) readonly buffer Pieces { Piece piece[]; };

layout(location = 0) flat out vec4 high;  // opaque surfaces; 1024 steps each
layout(location = 1) flat out vec3 low;   // single steps
layout(location = 2) flat out ivec4 weight;

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

invariant gl_Position;

void main() {
  Piece own = piece[gl_VertexID >> 2];
  uint vertex = own.corners[gl_VertexID & 3], i = vertex >> 1;
  precise vec3 fromEye = (positionOf(i) - eyeHigh.xyz) - eyeLow.xyz;
  precise vec4 clip = toClip * ((vertex & 1u) != 0u ? farPoint[i] : vec4(fromEye, 1.0));
  gl_Position = clip;
  weight = own.weight;
  // Both parts are small whole numbers, so that many thousands of them add up exactly in a float.
  ivec3 steps = own.weight.yzw, upper = (steps + 512) >> 10;
  high = vec4(own.weight.x, upper);
  low = vec3(steps - (upper << 10));
}
