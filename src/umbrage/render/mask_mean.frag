#version 450 core
// The mean of the masks of a light's points.
layout(binding = 1) uniform sampler2D sums;

layout(location = 0) out vec4 lit;

void main() {
  vec4 sum = texelFetch(sums, ivec2(gl_FragCoord.xy), 0);
  float weight = sum.y + sum.w;
  lit = vec4(weight > 0.0 ? (sum.x + sum.z) / weight : 0.0);
}
