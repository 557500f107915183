#include "umbrage/coin/detail/context_share.hpp"

#include <Inventor/elements/SoGLCacheContextElement.h>
#include <Inventor/misc/SoContextHandler.h>

#include <map>

#include "umbrage/gl/context.hpp"
#include "umbrage/gl/host_scope.hpp"

namespace umbrage::coin::detail {
namespace {

std::map<std::uint32_t, std::uint32_t>& names() {
  static std::map<std::uint32_t, std::uint32_t> all;
  return all;
}

void forget(std::uint32_t cacheContext, void*) {
  const auto known = names().find(cacheContext);
  if (known == names().end()) return;
  const std::uint32_t own = known->second;
  names().erase(known);
  SoContextHandler::destructingContext(own);
}

}  // namespace

std::uint32_t ownCacheContext(std::uint32_t cacheContext) {
  static const bool listens = [] {
    SoContextHandler::addContextDestructionCallback(forget, nullptr);
    return true;
  }();
  (void)listens;
  const auto [at, isNew] = names().try_emplace(cacheContext);
  if (isNew) at->second = SoGLCacheContextElement::getUniqueCacheContext();
  return at->second;
}

Result<void> checkTarget() {
  if (auto fine = gl::checkCurrentContext(); !fine) return fine;
  const gl::HostScope scope;
  if (scope.hostStencilBits() < 8) return fail(ErrorCode::device, "no shadows: the window has no 8 bits of stencil");
  if (scope.hostDepthBits() == 0) return fail(ErrorCode::device, "no shadows: the window has no depth");
  return {};
}

}  // namespace umbrage::coin::detail
