#pragma once

#include <string_view>

#include "umbrage/gl/objects.hpp"

namespace umbrage::gl {

/// A vertex and a fragment shader, linked. The sources are our own and embedded, so a fault in them is a bug: it aborts with
/// the compiler's log.
class Program {
 public:
  Program(std::string_view vertexSource, std::string_view fragmentSource);
  [[nodiscard]] unsigned name() const { return handle_.name(); }

 private:
  Handle handle_;
};

}  // namespace umbrage::gl
