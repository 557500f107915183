#version 450 core
// Marks over a picture, in clip coordinates worked out by the processor.
struct Mark {
  vec4 clip;
  vec4 colour;  // premultiplied by its alpha
  vec4 line;    // x: -1 .. 1 across a line, 0 on a face; y: half the line's width in pixels
};
layout(std430, binding = 0) readonly buffer Marks { Mark mark[]; };

layout(location = 0) out vec4 colour;
layout(location = 1) noperspective out float across;
layout(location = 2) flat out float halfWidth;

void main() {
  Mark m = mark[gl_VertexID];
  gl_Position = m.clip;
  colour = m.colour;
  across = m.line.x;
  halfWidth = m.line.y;
}
