#version 450 core
// As encode.frag. Where the sum has no alpha there is nothing but the background.
layout(std140, binding = 1) uniform Shading {
  vec4 rayCorner;   // the ray through window coordinates (x, y): rayCorner + x * rayX + y * rayY, relative to the eye
  vec4 rayX;
  vec4 rayY;
  vec4 lamp;        // relative to the eye; w = 0: the direction towards it
  vec4 radiance;    // here: the background, linear
  vec4 cone;        // a spot's direction and the cosine of its cutoff; w below -1: no cone
  vec4 sky;         // up, and the ambient light
  vec4 background;  // sRGB
};
layout(binding = 1) uniform sampler2D sum;

layout(location = 0) out vec4 colour;

void main() {
  vec4 light = texelFetch(sum, ivec2(gl_FragCoord.xy), 0);
  vec3 linear = clamp(light.rgb, 0.0, 1.0);
  vec3 curve = mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
  colour = vec4(light.a > 0.0 ? curve : background.rgb, 1.0);
}
