#version 450 core
// Only the stencil is written.
void main() {}
