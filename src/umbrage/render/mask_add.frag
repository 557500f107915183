#version 450 core
// Adds the mask of one point of a light with an extent to the sum of its half (shadow::LightSample::weight).
layout(std140, binding = 0) uniform View {
  mat4 toClip;     // from (position - eye, w)
  vec4 eyeHigh;    // the eye in two floats a component, so that position - eye is exact near the eye
  vec4 eyeLow;
  vec4 lightHigh;  // the light likewise; w = 0: the direction towards it
  vec4 lightLow;
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };

vec3 positionOf(uint i) { return vec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }
layout(std140, binding = 1) uniform Shading {
  vec4 rayCorner;   // the ray through window coordinates (x, y): rayCorner + x * rayX + y * rayY, relative to the eye
  vec4 rayX;
  vec4 rayY;
  vec4 light;       // relative to the eye; w = 0: the direction towards it
  vec4 radiance;    // linear colour x intensity
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 0) uniform usampler2D ids;
layout(binding = 1) uniform sampler2D mask;
const uint kNone = 0xffffffffu;
layout(std430, binding = 1) readonly buffer Triangles { vec4 triangle[]; };  // unit normal; material as the bits of w
layout(std430, binding = 2) readonly buffer Corners { uint corner[]; };

// Where the ray meets the plane of the triangle: exact to rounding at any distance, which a depth buffer is not.
vec3 seenPoint(uint id, vec3 ray) {
  vec3 a = (positionOf(corner[3u * id]) - eyeHigh.xyz) - eyeLow.xyz;
  float slope = dot(triangle[id].xyz, ray);
  return slope != 0.0 ? ray * (dot(triangle[id].xyz, a) / slope) : a;
}

layout(std140, binding = 2) uniform Sample {
  vec4 ball;       // centre relative to the eye, and radius; 0: all points count alike
  vec4 point;      // on it, relative to the eye; w: which half
};

layout(location = 0) out vec4 sums;

// A single point upon the ball would outweigh all others.
const float kMost = 4.0;

float weightAt(vec3 p) {
  float squareRadius = ball.w * ball.w;
  vec3 toCentre = ball.xyz - p, toPoint = point.xyz - p;
  float square = dot(toCentre, toCentre);
  if (square <= squareRadius) return 1.0;
  float along = dot(toCentre, toPoint);
  float passing = clamp(square - along * along / dot(toPoint, toPoint), 0.0, squareRadius);
  return min(kMost, square / (square + 0.5 * squareRadius - 1.5 * passing));
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  uint id = texelFetch(ids, at, 0).r;
  if (id == kNone) discard;
  vec3 ray = rayCorner.xyz + gl_FragCoord.x * rayX.xyz + gl_FragCoord.y * rayY.xyz;
  float weight = ball.w > 0.0 ? weightAt(seenPoint(id, ray)) : 1.0;
  vec2 sum = weight * vec2(texelFetch(mask, at, 0).r, 1.0);
  sums = point.w == 0.0 ? vec4(sum, 0.0, 0.0) : vec4(0.0, 0.0, sum);
}
