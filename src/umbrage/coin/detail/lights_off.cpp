#include "umbrage/coin/detail/lights_off.hpp"

#include <Inventor/fields/SoSFFloat.h>
#include <Inventor/nodes/SoNode.h>

#include <ranges>

#include "umbrage/coin/detail/lights.hpp"

namespace umbrage::coin::detail {

LightsOff::LightsOff(std::span<SoNode* const> lights) {
  for (SoNode* node : lights) {
    for (SoSFFloat* field : brightnessOf(*node)) {
      node->ref();
      const float value = field->getValue();  // a connected field is evaluated before it is overwritten
      saved_.push_back({node, field, value, field->isDefault() != FALSE, field->enableNotify(FALSE) != FALSE});
      field->setValue(0.0f);
    }
  }
}

LightsOff::~LightsOff() {
  for (const Saved& saved : std::views::reverse(saved_)) {
    saved.field->setValue(saved.value);
    saved.field->setDefault(saved.wasDefault ? TRUE : FALSE);
    saved.field->enableNotify(saved.notified ? TRUE : FALSE);
    saved.node->unref();
  }
}

}  // namespace umbrage::coin::detail
