#version 450 core
// The side of every triangle towards the light: lightSide of math/predicates.cpp, operation by operation. `precise` keeps the compiler from
// contracting or reordering, so that the signs are those of the processor, bit by bit.
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Query {
  dvec4 light;   // homogeneous, relative to the origin of the casters
  dvec4 eye;     // likewise
  uvec4 counts;  // triangles, edges, 1 to count every surface
  uvec4 format;  // indices a side, indices of the caps of a triangle, 1 for a list of edges
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangle[]; };  // sorted corners; component, and outward + 1 in two bits above it
layout(std430, binding = 2) writeonly buffer Sides { int side[]; };
layout(std430, binding = 3) buffer Seen { uint seenFromOutside[]; };  // per component

const double kRounding = 8.8817841970012523e-16lf;  // 2^-50

dvec3 at(uint i) { return dvec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

int lightSide(dvec3 a, dvec3 b, dvec3 c) {
  precise dvec3 ac = c - a;
  precise dvec3 al = light.xyz - a * light.w;
  precise dvec3 ab = b - a;
  precise double volume =
      (ac.y * al.z - ac.z * al.y) * ab.x + (ac.z * al.x - ac.x * al.z) * ab.y + (ac.x * al.y - ac.y * al.x) * ab.z;
  dvec3 c1 = abs(ac), l1 = abs(al), b1 = abs(ab);
  precise double size =
      (c1.y * l1.z + c1.z * l1.y) * b1.x + (c1.z * l1.x + c1.x * l1.z) * b1.y + (c1.x * l1.y + c1.y * l1.x) * b1.z;
  precise double bound = kRounding * size;
  if (abs(volume) <= bound) return 0;
  return volume > 0.0lf ? 1 : -1;
}

void main() {
  uint t = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (t >= counts.x) return;
  uvec4 row = triangle[t];
  int s = lightSide(at(row.x), at(row.y), at(row.z));
  side[t] = s;
  if (s * (int(row.w >> 30) - 1) > 0) atomicOr(seenFromOutside[row.w & 0x3fffffffu], 1u);
}
