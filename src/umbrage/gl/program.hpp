#pragma once

#include <string_view>

#include "umbrage/gl/objects.hpp"

namespace umbrage::gl {

/// Shaders, linked. The sources are our own and embedded, so a fault in them is a bug: it aborts with the compiler's log.
class Program {
 public:
  Program(std::string_view vertexSource, std::string_view fragmentSource);
  Program(std::string_view vertexSource, std::string_view geometrySource, std::string_view fragmentSource);
  [[nodiscard]] static Program compute(std::string_view source);
  [[nodiscard]] unsigned name() const { return handle_.name(); }

 private:
  Program() = default;
  Handle handle_;
};

}  // namespace umbrage::gl
