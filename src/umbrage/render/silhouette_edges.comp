#version 450 core
// One invocation an edge: sums the sides of its triangles and writes as many sides of the volume as the sum says. Places are handed out by a
// counter in the group first, so that there is one global atomic a group.
layout(local_size_x = 64) in;
layout(std140, binding = 0) uniform Query {
  dvec4 light;   // homogeneous, relative to the origin of the casters
  dvec4 eye;     // likewise
  uvec4 counts;  // triangles, edges, 1 to count every surface
  uvec4 format;  // indices a side: 6 two triangles, 3 one, 2 a line; .., 1 for a list of edges and multiplicities instead
};
layout(std430, binding = 0) readonly buffer Positions { float position[]; };
layout(std430, binding = 1) readonly buffer Edges { uvec4 edge[]; };  // its ends, its first use, its component; the row after the last ends the uses
layout(std430, binding = 2) readonly buffer Sides { int side[]; };
layout(std430, binding = 3) readonly buffer Uses { uint use[]; };  // a triangle; the top bit set where it counts with -1
layout(std430, binding = 4) readonly buffer Roles { uint role[]; };
layout(std430, binding = 5) writeonly buffer Indices { uint index[]; };
struct IndirectDraw { uint count, instances, firstIndex, baseVertex, baseInstance; };
layout(std430, binding = 6) buffer Draws {
  IndirectDraw draw[3];  // sides by z-pass, sides by z-fail, caps
  uint found;            // edges on the silhouette
};

const uint kLeftOut = 0u, kPass = 1u, kFail = 2u, kFailAtEye = 3u;

dvec3 at(uint i) { return dvec3(position[3u * i], position[3u * i + 1u], position[3u * i + 2u]); }

double squaredToSegment(dvec3 p, dvec3 a, dvec3 b) {
  dvec3 ab = b - a;
  double square = dot(ab, ab);
  double t = square > 0.0lf ? clamp(dot(p - a, ab) / square, 0.0lf, 1.0lf) : 0.0lf;
  dvec3 d = p - a - t * ab;
  return dot(d, d);
}

double squaredToRay(dvec3 p, dvec3 from, dvec3 direction) {
  double square = dot(direction, direction);
  double t = square > 0.0lf ? max(0.0lf, dot(p - from, direction) / square) : 0.0lf;
  dvec3 d = p - from - t * direction;
  return dot(d, d);
}

bool footInside(dvec3 p, dvec3 a, dvec3 b, dvec3 da, dvec3 db, dvec3 normal) {
  dvec3 inEdge = cross(normal, b - a);
  double outward = dot(inEdge, da) >= 0.0lf ? 1.0lf : -1.0lf;
  if (outward * dot(inEdge, p - a) < 0.0lf) return false;
  dvec3 inA = cross(normal, da), inB = cross(normal, db);
  double towardsB = dot(inA, b - a) >= 0.0lf ? 1.0lf : -1.0lf;
  return towardsB * dot(inA, p - a) >= 0.0lf && towardsB * dot(inB, p - b) <= 0.0lf;
}

// shadow::liesOnSide.
bool liesOnSide(uint first, uint second) {
  dvec3 a = at(first), b = at(second), p = eye.xyz;
  double limit = 2.384185791015625e-07lf * max(length(a - p), length(b - p));  // 2^-22
  dvec3 da = a * light.w - light.xyz, db = b * light.w - light.xyz;
  dvec3 normal = cross(b - a, da);
  double size = length(normal);
  if (size > 0.0lf) {
    if (abs(dot(normal, p - a)) > limit * size) return false;
    if (footInside(p, a, b, da, db, normal)) return true;
  }
  double square = limit * limit;
  return squaredToSegment(p, a, b) <= square || squaredToRay(p, a, da) <= square || squaredToRay(p, b, db) <= square;
}

// A cap that runs a -> b, counter-clockwise as the light sees it, is continued by a side that runs b -> a.
void writeSide(uint i, uint a, uint b) {
  if (format.x == 2u) {
    index[i] = 2u * a;
    index[i + 1u] = 2u * b;
    return;
  }
  index[i] = 2u * b;
  index[i + 1u] = 2u * a;
  index[i + 2u] = 2u * a + 1u;
  if (format.x == 3u) return;
  index[i + 3u] = 2u * b;
  index[i + 4u] = 2u * a + 1u;
  index[i + 5u] = 2u * b + 1u;
}

shared uint wanted[2], start[2], foundHere;

void main() {
  if (gl_LocalInvocationID.x == 0u) wanted[0] = wanted[1] = foundHere = 0u;
  barrier();
  uint e = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  int multiplicity = 0;
  uint which = 0u, place = 0u;
  uvec4 row = uvec4(0u);
  if (e < counts.y) {
    row = edge[e];
    uint part = role[row.w];
    which = part >= kFail ? 1u : 0u;
    uint end = part == kLeftOut ? row.z : edge[e + 1u].z;
    for (uint u = row.z; u < end; ++u) {
      int s = side[use[u] & 0x7fffffffu];
      multiplicity += (use[u] & 0x80000000u) != 0u ? -s : s;
    }
    if (multiplicity != 0) {
      atomicAdd(foundHere, 1u);
      if (part == kFailAtEye && liesOnSide(row.x, row.y)) multiplicity = 0;
    }
  }
  uint sides = format.z != 0u ? min(uint(abs(multiplicity)), 1u) : uint(abs(multiplicity));
  if (sides > 0u) place = atomicAdd(wanted[which], sides * format.x);
  barrier();
  if (gl_LocalInvocationID.x < 2u) {
    uint d = gl_LocalInvocationID.x;
    if (wanted[d] > 0u) start[d] = draw[d].firstIndex + atomicAdd(draw[d].count, wanted[d]);
    if (d == 0u && foundHere > 0u) atomicAdd(found, foundHere);
  }
  barrier();
  uint i = start[which] + place;
  if (format.z != 0u && sides > 0u) {
    index[i] = e;
    index[i + 1u] = uint(multiplicity);
    return;
  }
  for (uint k = 0u; k < sides; ++k, i += format.x)
    writeSide(i, multiplicity < 0 ? row.y : row.x, multiplicity < 0 ? row.x : row.y);
}
