#pragma once

#include <string>

#include "umbrage/base/error.hpp"

namespace umbrage::io::writer {

/// The bytes of a .glb file: its JSON text, and its numbers (which may be none). Errors: ErrorCode::output when it would be too large.
/// Source: Khronos, glTF 2.0 specification, 2021.
[[nodiscard]] Result<std::string> glbFile(const std::string& json, std::string binary);

}  // namespace umbrage::io::writer
