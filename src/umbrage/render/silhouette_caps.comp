#version 450 core
// Leaves out the averted faces of convex solids that the light sees from outside, and writes the caps of what is left.
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Query {
  dvec4 light;
  dvec4 eye;
  uvec4 counts;  // triangles, edges, 1 to count every surface
  uvec4 format;  // indices a side, indices of the caps of a triangle, 1 for a list of edges
};
layout(std430, binding = 1) readonly buffer Triangles { uvec4 triangle[]; };
layout(std430, binding = 2) buffer Sides { int side[]; };
layout(std430, binding = 3) readonly buffer Seen { uint seenFromOutside[]; };
layout(std430, binding = 4) readonly buffer Roles { uint role[]; };  // per component: render::Role
layout(std430, binding = 5) writeonly buffer Indices { uint index[]; };
struct IndirectDraw { uint count, instances, firstIndex, baseVertex, baseInstance; };
layout(std430, binding = 6) buffer Draws { IndirectDraw draw[3]; };  // sides by z-pass, sides by z-fail, caps

const uint kFail = 2u, kCaps = 2u;

shared uint wanted, start;

void main() {
  if (gl_LocalInvocationID.x == 0u) wanted = 0u;
  barrier();
  uint t = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  int s = 0;
  uint place = 0u;
  uvec4 row = uvec4(0u);
  bool capped = false;
  if (t < counts.x) {
    row = triangle[t];
    s = side[t];
    uint component = row.w & 0x3fffffffu;
    if (counts.z == 0u && s * (int(row.w >> 30) - 1) < 0 && seenFromOutside[component] != 0u) side[t] = s = 0;
    capped = s != 0 && role[component] >= kFail;
  }
  if (capped) place = atomicAdd(wanted, format.y);
  barrier();
  if (gl_LocalInvocationID.x == 0u && wanted > 0u) start = draw[kCaps].firstIndex + atomicAdd(draw[kCaps].count, wanted);
  barrier();
  if (!capped) return;
  uint i = start + place;
  uint b = s < 0 ? row.z : row.y, c = s < 0 ? row.y : row.z;
  index[i] = 2u * row.x;
  index[i + 1u] = 2u * b;
  index[i + 2u] = 2u * c;
  if (format.y < 6u) return;
  index[i + 3u] = 2u * row.x + 1u;
  index[i + 4u] = 2u * c + 1u;
  index[i + 5u] = 2u * b + 1u;
}
