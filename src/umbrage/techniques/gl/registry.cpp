#include "umbrage/techniques/gl/registry.hpp"

#include "umbrage/techniques/gl/soft.hpp"
#include "umbrage/techniques/gl/transparent.hpp"
#include "umbrage/techniques/gl/zfail.hpp"
#include "umbrage/techniques/gl/zmixed.hpp"
#include "umbrage/techniques/gl/zp_plus.hpp"
#include "umbrage/techniques/gl/zpass.hpp"

namespace umbrage::techniques {
namespace {

using ContextSlot = std::shared_ptr<std::shared_ptr<gl::Context>>;
using Maker = std::unique_ptr<render::GlTechnique> (*)(std::shared_ptr<gl::Context>, const render::VolumeOptions&);

shadow::TechniqueEntry entry(shadow::Traits traits, Maker make, ContextSlot slot,
                             const render::VolumeOptions& options) {
  return {std::move(traits), [make, slot, options]() -> Result<std::unique_ptr<shadow::Technique>> {
            if (*slot == nullptr) {
              auto context = gl::Context::createHeadless();
              if (!context) return tl::unexpected(context.error());
              *slot = std::move(*context);
            }
            return make(*slot, options);
          }};
}

}  // namespace

std::vector<shadow::TechniqueEntry> openGlTechniques(const render::VolumeOptions& options) {
  const auto slot = std::make_shared<std::shared_ptr<gl::Context>>();
  return {entry(zFailTraits(), makeZFail, slot, options),
          entry(zPassTraits(), makeZPass, slot, options),
          entry(zMixedTraits(), makeZMixed, slot, options),
          entry(zPassPlusTraits(), makeZPassPlus, slot, options),
          entry(transparentTraits(), makeTransparent, slot, options),
          entry(transparentZFailTraits(), makeTransparentZFail, slot, options),
          entry(softTraits(), makeSoft, slot, options)};
}

}  // namespace umbrage::techniques
