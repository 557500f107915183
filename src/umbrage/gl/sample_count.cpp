#include "umbrage/gl/sample_count.hpp"

#include <epoxy/gl.h>

#include "umbrage/base/check.hpp"

namespace umbrage::gl {

SampleCount::SampleCount(HostScope&) {
  glCreateQueries(GL_SAMPLES_PASSED, 1, &query_);
  glBeginQuery(GL_SAMPLES_PASSED, query_);
}

SampleCount::~SampleCount() {
  if (running_) glEndQuery(GL_SAMPLES_PASSED);
  glDeleteQueries(1, &query_);
}

std::uint64_t SampleCount::stop() {
  UMBRAGE_CHECK(running_, "a count ends once");
  running_ = false;
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint64 count = 0;
  glGetQueryObjectui64v(query_, GL_QUERY_RESULT, &count);
  return count;
}

}  // namespace umbrage::gl
