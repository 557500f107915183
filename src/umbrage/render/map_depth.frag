#version 450 core
// Only depth is written.
void main() {}
