#pragma once

#include <Inventor/nodes/SoSeparator.h>

#include <filesystem>

#include "ref.hpp"
#include "umbrage/base/error.hpp"

namespace umbrage::demo {

/// A model from an Inventor or VRML file, without its cameras and lights: the demo has its own.
/// Errors: ErrorCode::input when it cannot be read, is empty or contains itself.
[[nodiscard]] Result<Ref<SoSeparator>> readModel(const std::filesystem::path& file);

}  // namespace umbrage::demo
