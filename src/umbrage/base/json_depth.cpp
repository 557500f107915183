#include "umbrage/base/json_depth.hpp"

#include <string>

namespace umbrage {

Result<void> checkJsonDepth(std::string_view json, int most) {
  int depth = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '[' || c == '{') {
      if (++depth > most) return fail(ErrorCode::input, "is nested deeper than " + std::to_string(most) + " levels");
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return {};
}

}  // namespace umbrage
