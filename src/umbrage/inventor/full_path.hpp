#pragma once

#include <Inventor/SoFullPath.h>

namespace umbrage::inventor {

/// A path with the hidden children of node kits, which SoPath leaves out.
///
/// Coin means every SoPath to be taken for an SoFullPath. No object is of that class, so sanitizers are told to look away here and nowhere else.
class FullPath {
 public:
  /// REQUIRES: outlived by the path.
  explicit FullPath(const SoPath& path) : path_(&path) {}

  __attribute__((no_sanitize("vptr"))) [[nodiscard]] int length() const {
    return static_cast<const SoFullPath*>(path_)->getLength();
  }
  __attribute__((no_sanitize("vptr"))) [[nodiscard]] SoNode* node(int i) const {
    return static_cast<const SoFullPath*>(path_)->getNode(i);
  }
  /// Which child of the one above it is; 0 for the head.
  __attribute__((no_sanitize("vptr"))) [[nodiscard]] int index(int i) const {
    return static_cast<const SoFullPath*>(path_)->getIndex(i);
  }
  [[nodiscard]] SoNode* tail() const { return node(length() - 1); }
  [[nodiscard]] bool contains(const SoNode* wanted) const {
    for (int i = 0; i < length(); ++i)
      if (node(i) == wanted) return true;
    return false;
  }

 private:
  const SoPath* path_;
};

}  // namespace umbrage::inventor
