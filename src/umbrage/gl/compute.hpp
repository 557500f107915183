#pragma once

#include <cstddef>

#include "umbrage/gl/host_scope.hpp"
#include "umbrage/gl/objects.hpp"
#include "umbrage/gl/program.hpp"

namespace umbrage::gl {

/// Work without drawing: dispatches compute shaders, each of which sees what those before it wrote.
/// 1. At its end, everything written is seen by draws (as indices, as the numbers of indirect draws, as storage) and by Buffer::read.
/// REQUIRES: lives inside `scope`; does not nest with passes (checked).
class Compute {
 public:
  explicit Compute(HostScope& scope);
  Compute(const Compute&) = delete;
  Compute& operator=(const Compute&) = delete;
  ~Compute();

  void use(const Program& program);
  void uniforms(unsigned slot, const Buffer& buffer);
  void storage(unsigned slot, const Buffer& buffer);
  /// At least `items` invocations, in groups of `groupSize` (the shader's local_size_x), numbered
  /// (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * groupSize + gl_LocalInvocationID.x; those past the last item must do nothing.
  void dispatch(std::size_t items, unsigned groupSize);

 private:
  HostScope& scope_;
};

}  // namespace umbrage::gl
