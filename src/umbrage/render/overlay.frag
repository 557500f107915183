#version 450 core
layout(location = 0) in vec4 colour;
layout(location = 1) noperspective in float across;
layout(location = 2) flat in float halfWidth;
layout(location = 0) out vec4 result;

void main() {
  // Lines lose themselves over the outermost pixel.
  float cover = halfWidth > 0.0 ? clamp((1.0 - abs(across)) * halfWidth, 0.0, 1.0) : 1.0;
  result = colour * cover;
}
