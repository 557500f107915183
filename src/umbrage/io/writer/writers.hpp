#pragma once

#include <string>

#include "umbrage/base/error.hpp"
#include "umbrage/scene/scene.hpp"

namespace umbrage::io::writer {

/// What is to be written: the file's bytes, and those of a second file of the same name where the format has one.
struct Document {
  std::string content;
  std::string companion, companionExtension;
};

/// REQUIRES (all): a scene without a fault. `stem`: the name of the file without its extension.
[[nodiscard]] Result<Document> glb(const scene::Scene& scene, const std::string& stem);
[[nodiscard]] Result<Document> inventor(const scene::Scene& scene, const std::string& stem);
[[nodiscard]] Result<Document> cityJson(const scene::Scene& scene, const std::string& stem);
[[nodiscard]] Result<Document> obj(const scene::Scene& scene, const std::string& stem);

}  // namespace umbrage::io::writer
