#pragma once

#include <cstdint>
#include <limits>

// Plain data that the traversal works on. Compiled into files for several processors, so there are no functions here.
namespace umbrage::study::detail {

/// Eight boxes, their middles in the frame of the sun's legs, their half extents along east, north and up. Nothing is 1e18 away.
struct alignas(64) TreeNode {
  float first[8], west[8], south[8];
  float east[8], north[8], up[8];
  float flat[8];          ///< radius of the box about its middle, seen along the axis of the sun's motion
  std::int32_t child[8];  ///< a node, or ~leaf
};

/// Up to eight quads; unused lanes have no normal.
struct alignas(64) TreeLeaf {
  float first, west, south, east, north, up, flat;  ///< its box, as in a node
  float x[8], y[8], z[8];                           ///< a corner, in the scene's axes
  float nx[8], ny[8], nz[8];                        ///< unit normals, outwards where the solid is closed
  std::int32_t solid[8];                            ///< the closed solid it belongs to, or -1
  std::uint32_t quads;                              ///< where its quads begin
  std::uint32_t used;                               ///< bit k: lane k holds one
  std::uint32_t open;    ///< bit k: it belongs to no closed solid, so that both its sides are asked
  std::uint32_t flatUp;  ///< bit k: it looks straight up: who sees its outer side is above it, and so is the sun
};

/// A convex quad, or a triangle that names its last corner twice; counter-clockwise about the leaf's normal.
struct alignas(16) TreeQuad {
  float x[4], y[4], z[4];
};

/// Up to eight balls within closed solids, in the frame of the sun's legs; unused ones are 1e18 away.
struct alignas(64) TreeBalls {
  float first[8], west[8], south[8];
  float radius[8];  ///< less by what rounding moves the eye and the middle
};

/// SunArc in single precision, as a direction in the scene's axes: rise + cosine cos h + sine sin h.
struct ArcDirections {
  float rise[3], cosine[3], sine[3];
  float low, high;
};

/// Stretches of a leg, in pseudo-angles, sorted and apart; behind them at least eight of kNever.
struct Coverage {
  float* from;
  float* to;
  std::int32_t count, capacity;
  float first, binsPerUnit;
  std::uint64_t bins;  ///< those of 64 equal parts of the leg that are covered
};
inline constexpr float kNever = 1e30f;
/// Stretches nearer to each other than this are one; 0.03 s.
inline constexpr float kJoin = 2e-6f;

/// A point of a group: its coordinates as sums of two floats, and a number for callbacks.
struct GroupPoint {
  float high[3], low[3];
  std::uint32_t index;
};

inline constexpr int kGroup = 8;

/// All that one traversal needs: up to kGroup points that lie near each other and face one way.
struct CoverJob {
  const TreeNode* nodes;
  const TreeLeaf* leaves;
  const TreeQuad* quads;
  std::int32_t root;
  const TreeNode* ballNodes;  ///< null: none
  const TreeBalls* balls;
  std::int32_t ballRoot;
  // the place and the leg
  float sinLatitude, cosLatitude;
  float rise, cosine, sine, error;  ///< of SunLeg::whole
  float longest;                    ///< of the directions (cos h, sin h, height)
  float first, last;
  const ArcDirections* arcs;
  std::int32_t arcCount;
  // the group
  std::int32_t count;
  GroupPoint points[kGroup];
  Coverage covered[kGroup];
  alignas(32) float eyeFirst[kGroup], eyeWest[kGroup], eyeSouth[kGroup];  ///< the points in the frame of the legs
  float margin;                                                           ///< by how much that is rounded
  float middle[3];                                                        ///< in the frame of the legs
  float extent[3];                                                        ///< half, along east, north and up
  // The ways the points face, in the frame of the legs (0: all ways), and their absolute values along east, north and up: of each point, and
  // of one that stands for all, no farther from the others than `spread`.
  alignas(32) float facing[6][kGroup];
  float normal[6];
  float spread;
  const std::int32_t* within;  ///< closed solids whose boxes meet the group's
  std::int32_t withinCount;
  bool inside;    ///< some point may lie inside one of these, so that their averted faces are asked too
  float contact;  ///< how near to a plane a point touches it
  // what plain arithmetic does not settle
  void* context;
  /// Makes room in a coverage.
  void (*grow)(Coverage&);
  /// Solves the edges in `lanes` of a quad in double precision, between hours `first` and `last` of one arc; from[k], to[k]: between
  /// which hours the sun is on the inner side (a gap when from > to). Returns false when it never is at one of them.
  bool (*refine)(void* context, std::uint32_t point, std::uint32_t quad, std::uint32_t lanes, std::uint32_t arc,
                 float first, float last, float* from, float* to);
  /// A point very near the plane of a quad (`closed`: of a closed solid): returns true when it touches the quad, and then has added what
  /// that hides.
  bool (*touch)(void* context, std::uint32_t point, std::uint32_t quad, bool closed, Coverage& covered);
};

/// Fills `covered` of each of the job's points with the hours at which the scene hides the sun. What is covered already stays so.
void coverPlain(CoverJob& job);
void coverWide(CoverJob& job);
/// Adds a stretch to a coverage.
void addPlain(Coverage& covered, float from, float to, void (*grow)(Coverage&));

}  // namespace umbrage::study::detail
