#include "umbrage/inventor/written.hpp"

#include <Inventor/SoOutput.h>
#include <Inventor/actions/SoWriteAction.h>

#include <cstdlib>

namespace umbrage::inventor {

std::string written(SoNode* root) {
  constexpr std::size_t kFirst = 1 << 16;
  SoOutput output;
  output.setBuffer(std::malloc(kFirst), kFirst, std::realloc);
  SoWriteAction(&output).apply(root);
  void* buffer = nullptr;
  std::size_t size = 0;
  output.getBuffer(buffer, size);
  std::string text(static_cast<const char*>(buffer), size);
  std::free(buffer);
  return text;
}

}  // namespace umbrage::inventor
