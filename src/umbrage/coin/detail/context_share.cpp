#include "umbrage/coin/detail/context_share.hpp"

#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/misc/SoContextHandler.h>

#include <map>
#include <memory>

namespace umbrage::coin::detail {
namespace {

using Shares = std::map<std::uint32_t, std::unique_ptr<ContextShare>>;

// Never destroyed: at the end of the process no context is current that its objects could be taken from.
Shares& shares() {
  static Shares* all = new Shares;
  return *all;
}

void forget(std::uint32_t cacheContext, void*) {
  const auto known = shares().find(cacheContext);
  if (known == shares().end()) return;
  const auto gone = std::move(known->second);
  shares().erase(known);
  SoContextHandler::destructingContext(gone->cacheContext);
}

}  // namespace

ContextShare& shareOf(std::uint32_t cacheContext) {
  static const bool listens = [] {
    SoContextHandler::addContextDestructionCallback(forget, nullptr);
    return true;
  }();
  (void)listens;
  auto& share = shares()[cacheContext];
  if (share == nullptr) {
    share = std::make_unique<ContextShare>();
    share->cacheContext = SoGLCacheContextElement::getUniqueCacheContext();
  }
  return *share;
}

}  // namespace umbrage::coin::detail
