#pragma once

#include <string>

class SoNode;

namespace umbrage::inventor {

/// What Coin writes of a scene graph: an Inventor file's text.
[[nodiscard]] std::string written(SoNode* root);

}  // namespace umbrage::inventor
