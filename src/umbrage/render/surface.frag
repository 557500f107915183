#version 450 core
// What the camera sees: the triangle's number.
layout(std430, binding = 1) readonly buffer Ids { uint ids[]; };
layout(location = 0) out uint id;

void main() { id = ids[gl_PrimitiveID]; }
