#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io::detail {

// The flat form in which the reader process hands a scene, or the reason why there is none, to the library. Both run on one
// machine and belong to one build, so numbers are in memory order; the version only catches a stale reader.

[[nodiscard]] std::vector<std::byte> pack(const scene::Scene& scene);
[[nodiscard]] std::vector<std::byte> pack(const Error& error);

/// The scene or error that `bytes` hold. The bytes are not trusted: every size is held against what remains before memory is
/// taken for it. A hand-over that is cut short, has trailing bytes or breaks a law of Scene is an Error of its own.
[[nodiscard]] Result<scene::Scene> unpack(std::span<const std::byte> bytes);

}  // namespace umbrage::io::detail
