#include "umbrage/gl/compute.hpp"

#include <epoxy/gl.h>

#include <algorithm>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {
namespace {

// Every driver takes so many groups along one axis.
constexpr std::size_t kMostGroups = 65535;

}  // namespace

Compute::Compute(HostScope& scope) : scope_(scope) {
  UMBRAGE_CHECK(!scope.inPass_, "passes do not nest");
  scope.inPass_ = true;
}

Compute::~Compute() {
  glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_ELEMENT_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
  glUseProgram(0);
  scope_.inPass_ = false;
}

void Compute::use(const Program& program) { glUseProgram(program.name()); }

void Compute::uniforms(unsigned slot, const Buffer& buffer) {
  UMBRAGE_CHECK(slot < kUniformSlots, "HostScope does not save this slot");
  glBindBufferBase(GL_UNIFORM_BUFFER, slot, buffer.name());
}

void Compute::storage(unsigned slot, const Buffer& buffer) {
  UMBRAGE_CHECK(slot < kStorageSlots, "HostScope does not save this slot");
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, slot, buffer.name());
}

void Compute::dispatch(std::size_t items, unsigned groupSize) {
  const std::size_t groups = (items + groupSize - 1) / groupSize;
  if (groups == 0) return;
  const std::size_t rows = (groups + kMostGroups - 1) / kMostGroups;
  UMBRAGE_CHECK(rows <= kMostGroups, "more items than can be numbered");
  glDispatchCompute(static_cast<GLuint>(std::min(groups, kMostGroups)), static_cast<GLuint>(rows), 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace umbrage::gl
