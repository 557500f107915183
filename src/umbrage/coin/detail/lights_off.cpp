#include "umbrage/coin/detail/lights_off.hpp"

#include <Inventor/fields/SoSFBool.h>
#include <Inventor/nodes/SoNode.h>

#include <ranges>

#include "umbrage/coin/detail/lights.hpp"

namespace umbrage::coin::detail {

LightsOff::LightsOff(std::span<SoNode* const> lights) {
  for (SoNode* node : lights) {
    SoSFBool& on = switchOf(*node);
    node->ref();
    (void)on.getValue();  // a connected field is evaluated before it is overwritten
    saved_.push_back({node, on.isDefault() != FALSE, on.enableNotify(FALSE) != FALSE});
    on.setValue(FALSE);
  }
}

LightsOff::~LightsOff() {
  for (const Saved& saved : std::views::reverse(saved_)) {
    SoSFBool& on = switchOf(*saved.node);
    on.setValue(TRUE);
    on.setDefault(saved.wasDefault ? TRUE : FALSE);
    on.enableNotify(saved.notified ? TRUE : FALSE);
    saved.node->unref();
  }
}

}  // namespace umbrage::coin::detail
