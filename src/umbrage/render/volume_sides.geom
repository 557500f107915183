#version 450 core
// One side of a shadow volume from its edge, as the triangles that shadow::extrude would write, each starting at the same corner. Caps are never made
// here: they must have the very depths of the vertex shader.
layout(lines) in;
layout(triangle_strip, max_vertices = 6) out;
in Corner { vec4 far; } corner[];

void emit(vec4 clip) {
  gl_Position = clip;
  EmitVertex();
}

void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  emit(b);
  emit(a);
  emit(corner[0].far);
  EndPrimitive();
  if (corner[0].far == corner[1].far) return;  // a direction carries both ends to one point
  emit(b);
  emit(corner[0].far);
  emit(corner[1].far);
  EndPrimitive();
}
