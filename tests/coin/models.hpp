#pragma once

#include <filesystem>
#include <vector>

#include "coin/stage.hpp"

// The Inventor and VRML files of the test data, each in a room of its own measure.
namespace umbrage::coin::test {

/// Empty where there is no test data.
[[nodiscard]] std::vector<std::filesystem::path> modelFiles();

/// Without its cameras; null where it cannot be read.
[[nodiscard]] Ref<> readModel(const std::filesystem::path& file);

/// A camera that sees everything, and a group (groupOf) with one light or three, a floor below the model, and the model, last. Null for an empty model.
[[nodiscard]] Ref<> aroundModel(SoSeparator* model, int lights);

}  // namespace umbrage::coin::test
